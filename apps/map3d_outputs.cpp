#include "apps/map3d_outputs.hpp"

#include "flight/build_version.hpp"
#include "flight/pictures.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/report/report.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"
#include "rendering/picture3d.hpp"
#include "rendering/plot_svg.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

std::string plotOverFrames(const std::string& title, const std::string& label, const rendering::ThinnedCurve& curve) {
  rendering::Plot plot;
  plot.title = title;
  plot.x_label = "frame";
  plot.y_label = label;
  plot.series = {{"greatest of each stretch", curve.points(), false}};
  plot.y_min = 0.0;
  return rendering::plotSvg(plot);
}

std::string piecesText(const std::vector<common::Trajectory>& pieces) {
  std::string text = "# t x y z qx qy qz qw piece: piece 1 is the map; nothing says how the others lie to it\n";
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const common::StampedPose& at : pieces[i]) {
      text += interfaces::toTumLine(at);
      text.insert(text.size() - 1, " " + std::to_string(i + 1));
    }
  return text;
}

/// The three coordinates over time.
std::string positionPlot(const common::Trajectory& trajectory) {
  rendering::Plot plot;
  plot.title = "Position of the camera";
  plot.x_label = "time (s)";
  plot.y_label = "m";
  plot.series = {{"x", {}, false}, {"y", {}, false}, {"z", {}, false}};
  for (const common::StampedPose& at : trajectory) {
    const double time_s = (at.stamp - trajectory.front().stamp).seconds();
    for (int i = 0; i < 3; ++i)
      plot.series[static_cast<std::size_t>(i)].points.emplace_back(time_s, at.pose.position_m[i]);
  }
  return rendering::plotSvg(plot);
}

/// Turns the map upright. Its z axis is vertical, or its y axis points down as that of a first image does: whichever
/// fits how the camera was held.
common::Pose3 upright(const common::Trajectory& trajectory) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const common::StampedPose& at : trajectory) up -= at.pose.rotation * Eigen::Vector3d::UnitY();
  return up.z() > -up.y() ? common::Pose3{} : interfaces::T_camera_optical();
}

/// The cloud and the path of the camera from above at a slant.
std::string pictureOf(const Map3dMap& map, const common::Trajectory& trajectory) {
  const common::Pose3 T_shown_recorded = upright(trajectory);
  rendering::Picture3d picture;
  picture.surfaces.push_back({std::make_shared<const std::vector<common::SurfacePoint>>(map.cloud), T_shown_recorded});
  picture.lines.emplace_back();
  for (const common::StampedPose& at : trajectory)
    picture.lines.back().points_map_m.push_back(T_shown_recorded * at.pose.position_m);
  return flight::map3dPicture(picture);
}

}  // namespace

void writeMap3dOutputs(const fs::path& out, const std::vector<common::Trajectory>& pieces, const Map3dMap& map,
                       const Map3dFigures& figures) {
  const common::Trajectory& trajectory = pieces.front();
  auto writer = required(interfaces::TumWriter::create(out / "trajectory.tum"));
  for (const common::StampedPose& at : trajectory) required(writer.write(at));
  if (pieces.size() > 1) required(interfaces::writeAtomically(out / "pieces.txt", piecesText(pieces)));
  required(interfaces::writeCloud(out / "cloud.ply", map.cloud));
  required(interfaces::writeOctree(out / "map.bt", map.voxels));

  interfaces::MapReport report;
  report.version = flight::buildVersion();
  report.title = kMap3dTitle + fs::path(figures.folder).filename().string();
  report.subtitle = figures.folder;
  report.facts = figures.facts;
  report.warnings = figures.warnings;
  report.map3d_jpeg = pictureOf(map, trajectory);
  report.map_svg = positionPlot(trajectory);
  report.plots_svg = {plotOverFrames("Time per frame", "ms", figures.milliseconds),
                      plotOverFrames("Points that do not agree with the map", "part", figures.disagreement)};
  required(interfaces::writeAtomically(out / "report.html", interfaces::mapReport(report)));
}

}  // namespace swiftlet::apps
