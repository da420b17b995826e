// The figures of what behaviours promise.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

#include "common/rgbd_frame.hpp"
#include "evaluation/explored_check.hpp"
#include "evaluation/figure_measures.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {
namespace {

/// Between two places of the floor that are asked for: half of the smallest thing that a survey is to find.
constexpr double kFloorStep_m = 0.1;
/// A surface this little above the take-off floor is the floor.
constexpr double kFloor_m = 0.05;
/// A ray that ends this near to a place has met it.
constexpr double kMet_m = 0.03;

double angleToPoint_rad(const BehaviorRecord::View& view, const TrueWorld& world, const common::Pose3& T_world_map) {
  const common::Pose3 T_world_camera = view.T_world_body * world.T_body_camera;
  const Eigen::Vector3d point_world_m =
      T_world_map * Eigen::Vector3d(view.point_map_m.x(), view.point_map_m.y(), view.point_height_m.value_or(0.0));
  Eigen::Vector3d axis = T_world_camera.rotation * Eigen::Vector3d::UnitX();
  Eigen::Vector3d to_point = point_world_m - T_world_camera.position_m;
  if (!view.point_height_m) axis.z() = to_point.z() = 0.0;
  return std::acos(std::clamp(axis.normalized().dot(to_point.normalized()), -1.0, 1.0));
}

/// The shapes that a ray crosses an odd number of times.
std::set<int> crossedOddly(const simulation::RayCaster& rays, Eigen::Vector3d from_world_m,
                           const Eigen::Vector3d& direction) {
  constexpr double kFar_m = 100.0, kBeyond_m = 1e-4;  // Wider than every world; and beyond the surface just met.
  std::set<int> odd;
  for (simulation::Hit hit = rays.cast(from_world_m, direction, kFar_m); hit;
       hit = rays.cast(from_world_m, direction, kFar_m)) {
    if (!odd.insert(hit.shape).second) odd.erase(hit.shape);
    from_world_m += (hit.distance_m + kBeyond_m) * direction;
  }
  return odd;
}

/// Whether a place lies inside a solid shape, such as a wall: rays to opposite sides both leave it. The direction is
/// along no usual wall.
bool isInSolid(const simulation::RayCaster& rays, const Eigen::Vector3d& place_world_m) {
  const Eigen::Vector3d direction(0.8, 0.6, 0.0);
  const std::set<int> ahead = crossedOddly(rays, place_world_m, direction);
  if (ahead.empty()) return false;
  const std::set<int> behind = crossedOddly(rays, place_world_m, -direction);
  return std::any_of(ahead.begin(), ahead.end(), [&](int shape) { return behind.count(shape) > 0; });
}

/// The height at which most of the flight was; at its end the vehicle is lower than the tables.
double flightHeight_m(const std::vector<common::Pose3>& T_world_body_views) {
  std::vector<double> heights_m;
  heights_m.reserve(T_world_body_views.size());
  for (const common::Pose3& T_world_body : T_world_body_views) heights_m.push_back(T_world_body.position_m.z());
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  return *middle;
}

/// The floor of the area that nothing stands on or hangs above below the height of flight.
std::vector<Eigen::Vector3d> openFloor(const common::Polygon& area, const TrueWorld& world,
                                       const common::Pose3& T_world_map, double height_m) {
  std::vector<Eigen::Vector3d> floor_world_m;
  const Eigen::Vector2d low = area.min_map_m(), high = area.max_map_m();
  for (double y = low.y() + 0.5 * kFloorStep_m; y < high.y(); y += kFloorStep_m) {
    for (double x = low.x() + 0.5 * kFloorStep_m; x < high.x(); x += kFloorStep_m) {
      if (!area.contains({x, y})) continue;
      const Eigen::Vector3d above = T_world_map * Eigen::Vector3d(x, y, height_m);
      const auto hit = world.rays->cast(above, {0.0, 0.0, -1.0}, height_m + 1.0);
      if (std::abs(hit.distance_m - height_m) <= kFloor_m && !isInSolid(*world.rays, above))
        floor_world_m.push_back(T_world_map * Eigen::Vector3d(x, y, 0.0));
    }
  }
  return floor_world_m;
}

void keepGreatest(std::optional<double>& worst, double value) { worst = std::max(value, worst.value_or(value)); }
void keepLeast(std::optional<double>& worst, double value) { worst = std::min(value, worst.value_or(value)); }

/// The share of the time with the person 1.5 to 3 m away: the least of the flight modes, one after the other, in which
/// a person was followed, that of the first and that of the last mode.
void measureFollow(const std::vector<BehaviorRecord::Follow>& follows, FlightScore& score) {
  for (const BehaviorRecord::Follow& follow : follows) {
    if (follow.followed_s <= 0.0) continue;
    const double share = follow.in_distance_s / follow.followed_s;
    keepLeast(score["follow_share"], share);
    if (!score["follow_first_share"]) score["follow_first_share"] = share;
    score["follow_last_share"] = share;
    keepLeast(score["follow_nearest_m"], follow.nearest_m);
    keepGreatest(score["follow_farthest_m"], follow.farthest_m);
    keepGreatest(score["follow_lost_s"], follow.lost_s);
  }
}

bool sees(const common::PinholeCamera& camera, const common::RgbdCameraConfig& sheet, const TrueWorld& world,
          const common::Pose3& T_world_camera, const Eigen::Vector3d& place_world_m) {
  const Eigen::Vector3d in_camera = T_world_camera.inverse() * place_world_m;
  if (in_camera.x() < sheet.range_min_m || in_camera.x() > sheet.range_max_m) return false;
  const Eigen::Vector2d pixel = camera.pixel(in_camera);
  const bool in_picture =
      (pixel.array() >= 0.0).all() && pixel.x() <= camera.width_px - 1 && pixel.y() <= camera.height_px - 1;
  if (!in_picture) return false;
  const Eigen::Vector3d to_place_world_m = place_world_m - T_world_camera.position_m;
  return world.rays->cast(T_world_camera.position_m, to_place_world_m.normalized(), to_place_world_m.norm() + 1.0)
             .distance_m > to_place_world_m.norm() - kMet_m;
}

}  // namespace

std::optional<double> surveyCoverage(const common::Polygon& area, const TrueWorld& world,
                                     const common::Pose3& T_world_map,
                                     const std::vector<common::Pose3>& T_world_body_views) {
  if (!world.rgbd_camera || T_world_body_views.empty()) return std::nullopt;
  const double height_m = flightHeight_m(T_world_body_views) - T_world_map.position_m.z();
  std::vector<Eigen::Vector3d> unseen = openFloor(area, world, T_world_map, std::max(0.5, height_m));
  if (unseen.empty()) return std::nullopt;
  const auto whole = static_cast<double>(unseen.size());
  const common::PinholeCamera camera = world.rgbd_camera->camera();
  for (const common::Pose3& T_world_body : T_world_body_views) {
    const common::Pose3 T_world_camera = T_world_body * world.T_body_camera;
    std::erase_if(unseen, [&](const Eigen::Vector3d& place) {
      return sees(camera, *world.rgbd_camera, world, T_world_camera, place);
    });
  }
  return 1.0 - static_cast<double>(unseen.size()) / whole;
}

namespace {

/// The coloured targets, and what was recognized as targets of that name.
std::vector<common::Target> reportedBy(const BehaviorRecord& record) {
  std::vector<common::Target> reported = record.targets->targets;
  if (!record.objects) return reported;
  for (const common::RecognizedObject& object : record.objects->objects)
    if (object.confirmed)
      reported.push_back({.name = object.what,
                          .position_map_m = object.T_map_object.position_m,
                          .state = common::TargetState::kFound});
  return reported;
}

}  // namespace

/// The horizontal distance of where the vehicle stands at the end from the first of the trial's targets, if that is the
/// one it has landed on.
void measureLanding(const FlightRecord& flight, const std::vector<TrueTarget>& targets, FlightScore& score) {
  if (targets.empty() || !flight.motors_off) return;
  const Eigen::Vector3d off_m = flight.last_truth.T_world_body.position_m - targets.front().middle_world_m;
  if (const double distance_m = off_m.head<2>().norm(); distance_m <= kTargetMatch_m)
    score["landing_error_m"] = distance_m;
}

void measureBehaviors(const FlightRecord& flight, const TrueWorld& world, FlightScore& score) {
  const BehaviorRecord& record = flight.behaviors;
  if (record.keep_out_distance_m) score["keep_out_gap_m"] = *record.keep_out_distance_m - world.vehicle.hullRadius_m();
  for (const BehaviorRecord::View& view : record.inspecting)
    keepGreatest(score["inspect_axis_max_deg"], angleToPoint_rad(view, world, flight.T_world_map) / common::kRadPerDeg);
  for (const common::Polygon& area : record.surveyed)
    if (const auto share = surveyCoverage(area, world, flight.T_world_map, flight.T_world_body_views))
      keepLeast(score["survey_coverage"], *share);
  for (const BehaviorRecord::Explored& explored : record.explored) {
    const auto [area, volume] = checkExplored(explored, world, flight.T_world_map);
    if (area) keepGreatest(score["explored_unseen_share"], area->unseen_share);
    if (volume) keepGreatest(score["explored_unseen_volume_share"], volume->unseen_share);
    score.certificates.push_back(certificateOf(area, volume));
  }
  measureFollow(record.follows, score);
  if (record.targets) measureTargets(reportedBy(record), world.targets, flight.T_world_map, score);
  measureLanding(flight, world.targets, score);
}

}  // namespace swiftlet::evaluation
