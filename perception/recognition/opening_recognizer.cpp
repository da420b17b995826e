#include "perception/recognition/opening_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/square.hpp"
#include "perception/recognition/mirror_check.hpp"
#include "perception/recognition/wall_holes.hpp"

namespace swiftlet::perception {
namespace {

/// Between a hatch and a double door; what is smaller lets no hull of 0.55 m through.
constexpr double kLeastSize_m = 0.35, kGreatestWidth_m = 2.6, kGreatestHeight_m = 2.8;
/// A rectangle is filled but for what stands before it and what the noise takes from its rim.
constexpr double kFilled = 0.7, kOverfilled = 1.2;
/// At 60 degrees a reveal of 0.25 m hides 0.43 m of the space behind an opening of 0.65 m.
constexpr double kOpen = 0.3, kClosed = 0.05;
/// Panes and leaves are set back by less; a shelf is deeper.
constexpr double kRecess_m = 0.15;
/// Of beams through an opening this share ends behind the wall, if it is open.
constexpr double kBeamsBehind = 0.3;
constexpr int kLeastBeams = 5;
/// A side that is not seen may be anywhere within this standard deviation.
constexpr double kUnseenSigma_m = 0.5;
/// What is left of the confidence where the scan does not tell an opening from a mirror.
constexpr double kMaybeMirror = 0.5;
/// Of the inverse depth, equal in all pixels (config/nature/real.yaml: within 0.001).
constexpr double kBiasSigma_1_m = 0.0006;
/// Every so many pixels of an opening one is compared with the scan.
constexpr std::size_t kEvery = 7;
/// Two pieces of one wall: their angles, and how far the ends are from the line between them.
constexpr double kSameAngle_rad = 0.09, kSameWall_m = 0.08;
/// Two recognitions whose middles are this near are of one opening.
constexpr double kSamePlace_m = 0.3;

bool hasShape(const WallHole& hole) {
  const bool has_end =
      hole.sides[WallHole::kTop].end == HoleEnd::kWall || hole.sides[WallHole::kBottom].end == HoleEnd::kWall;
  const double width_m = hole.width_m(), height_m = hole.height_m();
  return has_end && width_m >= kLeastSize_m && width_m <= kGreatestWidth_m && height_m >= kLeastSize_m &&
         height_m <= kGreatestHeight_m && hole.filled >= kFilled && hole.filled <= kOverfilled;
}

const char* nameOf(const WallHole& hole) {
  const HoleEnd below = hole.sides[WallHole::kBottom].end;
  return below == HoleEnd::kFloor ? "door" : below == HoleEnd::kWall ? "window" : "opening";
}

/// What the camera sees in the room behind; the reveal is at the wall, as its reflection would be.
std::vector<Eigen::Vector3d> behind(const WallHole& hole, const DepthView& view) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < hole.pixels.size(); i += kEvery) {
    const int u = hole.pixels[i] % view.camera.width_px, v = hole.pixels[i] / view.camera.width_px;
    const float depth_m = view.depth.at(u, v);
    if (!common::isMeasured(depth_m)) continue;
    const Eigen::Vector3d point = static_cast<double>(depth_m) * view.ray(u, v);
    if (hole.wall.normal().dot(point) - hole.wall.distance_m() > kRoomBehind_m) points.push_back(point);
  }
  return points;
}

/// The beams through the hole: how far behind the wall they end, and where.
struct BeamsThrough {
  int all = 0, behind = 0;
  std::vector<Eigen::Vector3d> points_m;  ///< Of those that end behind.
};

BeamsThrough beamsThrough(const WallHole& hole, const LevelScan& scan) {
  BeamsThrough through;
  const Eigen::Vector3d normal = hole.wall.normal(), right = hole.wall.right();
  const double distance_m = hole.wall.distance_m(), start_m = normal.dot(scan.origin_m());
  for (const Eigen::Vector3d& point : scan.ends_m()) {
    const double end_m = normal.dot(point);
    if (end_m - start_m < 1e-3) continue;
    const double share = (distance_m - start_m) / (end_m - start_m);
    const Eigen::Vector3d at = scan.origin_m() + share * (point - scan.origin_m());
    const double along_m = right.dot(at);
    // Beams beside the edges end at the reveal.
    const double margin_m = 0.2 * hole.width_m();
    if (share < 0.0 || along_m < hole.sides[WallHole::kLeft].place_m + margin_m ||
        along_m > hole.sides[WallHole::kRight].place_m - margin_m || at.z() > hole.sides[WallHole::kTop].place_m ||
        at.z() < hole.sides[WallHole::kBottom].place_m)
      continue;
    ++through.all;
    if (end_m - distance_m < kRoomBehind_m) continue;
    ++through.behind;
    through.points_m.push_back(point);
  }
  return through;
}

/// By the depths; near the end of the camera's range what is too far may be just behind the wall, and the scan decides.
Passage passageOf(const WallHole& hole, const BeamsThrough& through) {
  const bool beams_tell = through.all >= kLeastBeams;
  if (beams_tell && through.behind < kBeamsBehind * through.all)
    return hole.deep <= kClosed && hole.measured > 0.5 && hole.recess_m < kRecess_m ? Passage::kClosed : Passage::kNone;
  if (hole.deep >= kOpen) return Passage::kOpen;
  if (hole.measured > 0.5) return hole.deep <= kClosed && hole.recess_m < kRecess_m ? Passage::kClosed : Passage::kNone;
  return beams_tell ? Passage::kOpen : Passage::kNone;
}

double variance_m2(const HoleSide& side) {
  return std::isfinite(side.sigma_m) ? common::square(side.sigma_m) : common::square(2.0 * kUnseenSigma_m);
}

Recognized recognizedOf(const WallHole& hole, const DepthView& view, Passage passage) {
  Recognized object;
  object.what = nameOf(hole);
  object.passage = passage;
  object.size_m = {hole.width_m(), hole.height_m()};
  object.confidence = std::min(1.0, hole.framed * std::min(1.0, hole.filled));
  const Eigen::Vector3d centre = hole.centre(), right = hole.wall.right(), up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead = up.cross(right);
  Eigen::Matrix3d R_level_object;
  R_level_object << -ahead, right, up;
  const Eigen::Matrix3d R_camera_level = view.R_level_camera.transpose();
  object.T_sensor_object = {Eigen::Quaterniond(R_camera_level * R_level_object), R_camera_level * centre};
  Eigen::Matrix3d k = hole.wall.covariance_1_m2;
  // An inverse depth that is off by b moves the centre by b depth^2 along the view, as k off by b along the view does.
  const Eigen::Vector3d view_axis = view.ray(view.camera.cx_px, view.camera.cy_px);
  k += common::square(kBiasSigma_1_m) * view_axis * view_axis.transpose();
  const double distance_m = hole.wall.distance_m();
  // A point of the plane slides along its ray p by -(p . dk) p; the rest is across, by the errors of the sides.
  Eigen::Matrix3d position = centre.dot(k * centre) * centre * centre.transpose();
  position += 0.25 * (variance_m2(hole.sides[WallHole::kLeft]) + variance_m2(hole.sides[WallHole::kRight])) * right *
              right.transpose();
  position += 0.25 * (variance_m2(hole.sides[WallHole::kTop]) + variance_m2(hole.sides[WallHole::kBottom])) * up *
              up.transpose();
  // The normal turns by the part of dk across it, over |k|.
  const Eigen::Matrix3d turn = common::skew(ahead) * distance_m;
  object.covariance.topLeftCorner<3, 3>() = R_camera_level * turn * k * turn.transpose() * R_camera_level.transpose();
  object.covariance.bottomRightCorner<3, 3>() = R_camera_level * position * R_camera_level.transpose();
  return object;
}

/// The surest of those in one place. A wall and its frame make two planes and one opening.
void addSurest(std::vector<Recognized>& recognized, Recognized object) {
  for (Recognized& one : recognized) {
    if ((one.T_sensor_object.position_m - object.T_sensor_object.position_m).norm() > kSamePlace_m) continue;
    if (object.confidence > one.confidence) one = std::move(object);
    return;
  }
  recognized.push_back(std::move(object));
}

/// Where the line from the end of one wall to the begin of the next leads along both: a wall with a gap.
bool isOneWall(const ScanLine& a, const ScanLine& b) {
  const Eigen::Vector2d along = b.end_m - a.begin_m;
  const Eigen::Vector2d normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
  return std::abs(std::remainder(a.angle_rad - b.angle_rad, 2.0 * std::numbers::pi)) < kSameAngle_rad &&
         std::abs(normal.dot(a.end_m - a.begin_m)) < kSameWall_m &&
         std::abs(normal.dot(b.begin_m - a.begin_m)) < kSameWall_m;
}

/// Beams between two bearings: through to behind the line through both ends, on it, or nearer.
bool seesThrough(const common::LaserScan& scan, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                 std::vector<Eigen::Vector3d>& behind_m) {
  const Eigen::Vector2d along = (to_m - from_m).normalized();
  Eigen::Vector2d normal(-along.y(), along.x());
  if (normal.dot(from_m) < 0.0) normal = -normal;
  const double distance_m = normal.dot(from_m);
  int all = 0, through = 0, nearer = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Eigen::Vector2d ray(std::cos(angle_rad), std::sin(angle_rad));
    if (!(normal.dot(ray) > 0.0)) continue;
    const double at_m = along.dot(distance_m / normal.dot(ray) * ray - from_m);
    const double range_m = scan.ranges_m[i];
    if (at_m < 0.0 || at_m > (to_m - from_m).norm() || std::isnan(range_m) || range_m < scan.range_min_m) continue;
    ++all;
    const double beyond_m = range_m * normal.dot(ray) - distance_m;
    if (beyond_m < -kSameWall_m) ++nearer;
    if (beyond_m < kRoomBehind_m) continue;
    ++through;
    const Eigen::Vector2d end = std::min(range_m, scan.range_max_m) * ray;
    behind_m.emplace_back(end.x(), end.y(), 0.0);
  }
  return all >= kLeastBeams && through >= kBeamsBehind * all && nearer <= 0.1 * all;
}

Recognized gapOf(const ScanLine& a, const ScanLine& b, double spacing_rad, double range_sigma_m) {
  const Eigen::Vector2d middle = 0.5 * (a.end_m + b.begin_m), along = (b.begin_m - a.end_m).normalized();
  Eigen::Vector2d normal(along.y(), -along.x());
  if (normal.dot(middle) > 0.0) normal = -normal;  // Towards the laser.
  Recognized object{"opening",
                    common::lifted({middle.x(), middle.y(), std::atan2(normal.y(), normal.x())}, 0.0),
                    {},
                    std::min(1.0, std::min(a.beams, b.beams) / 50.0)};
  // An edge lies within one step between two beams, which a slanted wall draws out.
  const auto edge_m2 = [&](const Eigen::Vector2d& edge) {
    const double step_m = spacing_rad * edge.squaredNorm() / std::max(1e-3, std::abs(normal.dot(edge)));
    return common::square(step_m) + common::square(range_sigma_m);
  };
  const Eigen::Matrix2d across = normal * normal.transpose();
  object.covariance.setZero();
  object.covariance.block<2, 2>(3, 3) = 0.25 * (edge_m2(a.end_m) + edge_m2(b.begin_m)) * along * along.transpose() +
                                        0.5 * (a.covariance(1, 1) + b.covariance(1, 1)) * across;
  object.covariance(2, 2) = 0.5 * (a.covariance(0, 0) + b.covariance(0, 0));
  object.size_m.x() = (b.begin_m - a.end_m).norm();
  object.passage = Passage::kOpen;
  return object;
}

std::vector<Eigen::Vector3d> turned(const std::vector<Eigen::Vector3d>& points_camera_m, const DepthView& view) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& point : points_camera_m) points.emplace_back(view.R_level_camera * point);
  return points;
}

/// nullopt if it is none.
std::optional<Recognized> recognizedAs(const WallHole& hole, const DepthView& view,
                                       const std::optional<LevelScan>& scan) {
  if (!hasShape(hole)) return std::nullopt;
  const BeamsThrough through = scan ? beamsThrough(hole, *scan) : BeamsThrough();
  const Passage passage = passageOf(hole, through);
  if (passage == Passage::kNone) return std::nullopt;
  Recognized object = recognizedOf(hole, view, passage);
  if (passage == Passage::kClosed || !scan) return object;
  std::vector<Eigen::Vector3d> points = behind(hole, view);
  points.insert(points.end(), through.points_m.begin(), through.points_m.end());
  const Reflection reflection = reflectionOf(points, hole.wall, *scan);
  if (reflection == Reflection::kYes) {
    object.what = "mirror";
    object.passage = Passage::kClosed;
  }
  if (reflection == Reflection::kMaybe) object.confidence *= kMaybeMirror;
  return object;
}

void sortBySureness(std::vector<Recognized>& recognized) {
  std::stable_sort(recognized.begin(), recognized.end(),
                   [](const Recognized& a, const Recognized& b) { return a.confidence > b.confidence; });
}

}  // namespace

std::vector<Recognized> OpeningRecognizer::recognize(const Observation& observation) {
  if (!hasWholeDepths(observation)) return {};
  const DepthView view{observation.frame->camera, observation.frame->depth,
                       observation.R_level_camera.toRotationMatrix(), config_.inverse_depth_sigma_1_m,
                       config_.range_max_m};
  std::optional<LevelScan> scan;
  if (observation.scan != nullptr)
    scan.emplace(*observation.scan,
                 common::Pose3{observation.R_level_camera, Eigen::Vector3d::Zero()} * observation.T_camera_laser);
  if (scan && observation.seen_before_m != nullptr) scan->addSeenBefore(turned(*observation.seen_before_m, view));
  std::vector<Recognized> recognized;
  for (const WallPlane& wall : findWalls(view))
    for (const WallHole& hole : findHoles(view, wall))
      if (auto object = recognizedAs(hole, view, scan)) addSurest(recognized, *std::move(object));
  sortBySureness(recognized);
  return recognized;
}

std::vector<Recognized> ScanOpeningRecognizer::recognize(const Observation& observation) {
  if (observation.scan == nullptr) return {};
  const common::LaserScan& scan = *observation.scan;
  const std::vector<ScanLine> lines = findLines(scan, config_.lines);
  std::vector<Recognized> recognized;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const ScanLine &a = lines[i], &b = lines[j];
      const double width_m = (b.begin_m - a.end_m).norm();
      if (width_m < kLeastSize_m || width_m > kGreatestWidth_m || !isOneWall(a, b)) continue;
      std::vector<Eigen::Vector3d> behind_m;
      if (!seesThrough(scan, a.end_m, b.begin_m, behind_m)) continue;
      WallPlane wall;
      const Eigen::Vector2d normal = a.normal();
      wall.inverse_1_m.head<2>() = normal / std::max(1e-3, normal.dot(0.5 * (a.end_m + b.begin_m)));
      const Reflection reflection = reflectionOf(behind_m, wall, LevelScan(scan, common::Pose3{}));
      if (reflection == Reflection::kYes) continue;
      recognized.push_back(gapOf(a, b, std::abs(scan.angle_increment_rad), config_.lines.range_sigma_m));
    }
  sortBySureness(recognized);
  return recognized;
}

}  // namespace swiftlet::perception
