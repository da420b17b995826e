#include "autonomy/estimation/stereo_scale.hpp"

#include <algorithm>
#include <cmath>

#include "common/quantile.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

constexpr int kEvery_px = 6;        ///< A median needs no more pixels.
constexpr double kAround_m = 0.3;   ///< From the vertical: what is there lies as high as under the beams, mostly.
constexpr std::size_t kLeast = 20;  ///< Points of a pair.
/// Beams are kept for longer than a pair is late: 0.35 s at 3 Hz (Tomic 2012, "Data Fusion").
constexpr double kRemembered_s = 1.0;
/// The vehicle tilts and climbs little within the period of a laser at 10 Hz.
constexpr double kSameTime_s = 0.06;
/// Five seconds at 4 Hz: a vehicle passes the edge of a table in less.
constexpr std::size_t kPairs = 20, kLeastPairs = 12;
/// What beams and pairs differ by at 1 m though the sheet is right: mounts to 2 cm, ranges to 1 cm, disparities to 0.1
/// px of 27.
constexpr double kTolerance = 0.05;

}  // namespace

std::vector<Eigen::Vector3f> pointsBelow_body_m(const common::RgbdFrame& frame, const common::Pose3& T_body_camera) {
  std::vector<Eigen::Vector3f> points_body_m;
  for (int v = 0; v < frame.depth.height_px; v += kEvery_px)
    for (int u = 0; u < frame.depth.width_px; u += kEvery_px) {
      const float depth_m = frame.depth.at(u, v);
      if (!common::isMeasured(depth_m)) continue;
      const Eigen::Vector3d point_body_m =
          T_body_camera * frame.camera.point_camera_m(u, v, static_cast<double>(depth_m));
      if (point_body_m.z() < 0.0 && point_body_m.head<2>().norm() <= kAround_m)
        points_body_m.push_back(point_body_m.cast<float>());
    }
  return points_body_m;
}

void StereoScale::addBeams(Time stamp, double below_m, const Eigen::Quaterniond& R_level_body) {
  beams_.push_back({stamp, below_m, R_level_body});
  while ((stamp - beams_.front().stamp).seconds() > kRemembered_s) beams_.pop_front();
}

void StereoScale::addPair(Time stamp, const std::vector<Eigen::Vector3f>& points_body_m) {
  if (points_body_m.size() < kLeast) return;
  const auto off_s = [stamp](const Beams& beams) { return std::abs((beams.stamp - stamp).seconds()); };
  const auto beams = std::min_element(beams_.begin(), beams_.end(),
                                      [&](const Beams& a, const Beams& b) { return off_s(a) < off_s(b); });
  if (beams == beams_.end() || off_s(*beams) > kSameTime_s) return;
  const Eigen::Vector3d up_body = beams->R_level_body.conjugate() * Eigen::Vector3d::UnitZ();
  const double camera_m = up_body.dot(camera_body_m_);
  std::vector<double> heights_m;
  for (const Eigen::Vector3f& point_body_m : points_body_m)
    heights_m.push_back(camera_m - up_body.dot(point_body_m.cast<double>()));
  measured_.push_back(common::quantile(heights_m, 0.5) / (beams->below_m + camera_m));
  if (measured_.size() > kPairs) measured_.pop_front();
}

std::optional<double> StereoScale::scale() const {
  if (measured_.size() < kLeastPairs) return std::nullopt;
  return common::quantile({measured_.begin(), measured_.end()}, 0.5);
}

std::optional<common::Message> StereoScale::contradiction() const {
  const auto measured = scale();
  if (!measured || std::abs(*measured - 1.0) <= kTolerance) return std::nullopt;
  return common::Message("stereo.scale",
                         "the beams down contradict the depths: these are {:.0f} % of what they should be, so the base "
                         "or the focal length is not that of the sheet",
                         100.0 * *measured);
}

}  // namespace swiftlet::autonomy
