// Inspect: orbits a point with the nose, and so the camera, on it. First it flies to the nearest place of the circle
// and turns to the point. Parts of the circle that are not free are left out.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "autonomy/maneuvers/table.hpp"
#include "autonomy/maneuvers/tour.hpp"
#include "common/geometry.hpp"
#include "common/goal.hpp"
#include "common/hysteresis.hpp"

namespace swiftlet::autonomy {
namespace {

/// Places of a full circle: a chord between two is 1 % of the radius off the circle.
constexpr int kPlaces = 24;
/// Passing a place this near counts, and the vehicle is on its circle.
constexpr double kOnCircle_m = 0.15;
/// From then on the vehicle may leave its first place: well within half of a camera's opening angle, and above the
/// yaw's error in a hover, 1 deg.
constexpr double kFacesPoint_rad = 3.0 * common::kRadPerDeg;
/// It must face the point for this long: a heading that swings through leaves the point again.
constexpr double kFacesFor_s = 0.4;
/// A height that is off by more than this is reported.
constexpr double kPassesBy_m = 0.05;

/// The height of the body from which the camera's axis meets the point.
double heightToSee_m(const Eigen::Vector2d& distance_height_m, const common::Pose3& T_body_camera) {
  const Eigen::Vector3d axis = T_body_camera.rotation * Eigen::Vector3d::UnitX();
  const double ahead_m = distance_height_m.x() - T_body_camera.position_m.x();
  return distance_height_m.y() - ahead_m * axis.z() / std::max(0.1, axis.x()) - T_body_camera.position_m.z();
}

class Inspect final : public Tour {
 public:
  Inspect(const common::InspectIntent& intent, const ManeuverSetup& setup);

 private:
  void watch(const ManeuverInput& input) override;
  common::Pose3 T_body_camera(const ManeuverInput& input) const;
  double headingToSee_rad(const ManeuverInput& input) const;
  std::vector<Eigen::Vector2d> lay(const planning::CostMap& map, const ManeuverInput& input) override;
  bool ready(const ManeuverInput& input) override;
  bool inspecting(const ManeuverInput& input) const override;
  void chooseHeight(const ManeuverInput& input);
  bool isOnCircle(const ManeuverInput& input) const;
  std::string doing(const ManeuverInput& input) const override;

  common::InspectIntent intent_;
  common::Hysteresis faces_{kFacesFor_s};  ///< The point; updated until it does, since it began or was interrupted.
};

Inspect::Inspect(const common::InspectIntent& intent, const ManeuverSetup& setup)
    : Tour(setup, "inspect a point", intent.mode, kOnCircle_m), intent_(intent) {
  if (intent.height_m) setup.memory.cruise_height_m = *intent.height_m;
}

/// As the flight has estimated the mount, where it has: 1 deg of it is a fifth of what the axis may be off.
common::Pose3 Inspect::T_body_camera(const ManeuverInput& input) const {
  if (input.map3d && input.map3d->frame) return input.map3d->camera.T_body_camera;
  return setup_.camera != nullptr ? setup_.camera->mount.pose() : common::Pose3{};
}

/// The heading in `map` at which the camera's axis passes over the point.
double Inspect::headingToSee_rad(const ManeuverInput& input) const {
  const Eigen::Vector2d look = intent_.point_map_m - input.position_map_m();
  return std::atan2(look.y(), look.x()) - common::yawOf(T_body_camera(input).rotation);
}

void Inspect::watch(const ManeuverInput& input) {
  const double heading_rad = headingToSee_rad(input);
  setup_.controller.lookAt(input.position_map_m() +
                           intent_.radius_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
}

/// The height from which the camera's axis meets the point, within the bounds of the flight.
void Inspect::chooseHeight(const ManeuverInput& input) {
  const double wanted_m = heightToSee_m({intent_.radius_m, *intent_.point_height_m}, T_body_camera(input));
  const double greatest_m = setup_.controller.maxHeight_m();
  setup_.memory.cruise_height_m = std::clamp(wanted_m, std::min(common::kLeastFlightHeight_m, greatest_m), greatest_m);
  if (std::abs(setup_.memory.cruise_height_m - wanted_m) > kPassesBy_m)
    setup_.memory.log.warn(
        input.now, kFlightSource, "the camera's axis misses the point",
        fmt::format("it meets the point from a height of {:.2f} m, which is out of bounds", wanted_m));
}

std::vector<Eigen::Vector2d> Inspect::lay(const planning::CostMap& map, const ManeuverInput& input) {
  if (!intent_.height_m && setup_.camera != nullptr && intent_.point_height_m) chooseHeight(input);
  const Eigen::Vector2d from_point = input.position_map_m() - intent_.point_map_m;
  const auto placeAt = [&](double angle_rad) -> Eigen::Vector2d {
    return intent_.point_map_m + intent_.radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  };
  const double step_rad = 2.0 * std::numbers::pi / kPlaces;
  double first_rad = std::atan2(from_point.y(), from_point.x());
  for (int i = 0; i < kPlaces && isLethalAt(map, placeAt(first_rad)); ++i)
    first_rad += i % 2 == 0 ? (i + 1) * step_rad : -(i + 1) * step_rad;  // Nearest first, to both sides.
  std::vector<Eigen::Vector2d> places;
  const int count = static_cast<int>(std::lround(intent_.turns * kPlaces));
  for (int i = 0; i <= count; ++i) places.push_back(placeAt(first_rad + i * step_rad));
  return places;
}

std::string Inspect::doing(const ManeuverInput& input) const {
  if (passed() == 0) return "flying to the circle";
  return isOnCircle(input) ? "inspecting" : "flying around what stands on the circle";
}

/// It has turned to the point, at the first place or where it goes on after an interruption, and left that place.
bool Inspect::inspecting(const ManeuverInput& input) const {
  return faces_.active() && passed() > 1 && isOnCircle(input);
}

bool Inspect::isOnCircle(const ManeuverInput& input) const {
  return std::abs((input.position_map_m() - intent_.point_map_m).norm() - intent_.radius_m) < kOnCircle_m;
}

bool Inspect::ready(const ManeuverInput& input) {
  if (passed() == 0 || faces_.active()) return true;
  const double yaw_rad = input.state.T_map_body_planar().yaw_rad;
  faces_.update(std::abs(common::wrapAngle(headingToSee_rad(input) - yaw_rad)) < kFacesPoint_rad, input.now);
  return faces_.active();
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::InspectIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Inspect>(intent, setup);
}

}  // namespace swiftlet::autonomy
