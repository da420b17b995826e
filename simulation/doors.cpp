#include "simulation/doors.hpp"

#include <algorithm>
#include <functional>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/validation.hpp"

namespace swiftlet::simulation {

using common::Message;

void DoorConfig::describe(common::config::Fields& fields) {
  fields("name", name, "Name of the door.");
  fields("x_m", x_m, {-1e4, 1e4}, "Middle of the door along the world's x.");
  fields("y_m", y_m, {-1e4, 1e4}, "Middle of the door along the world's y.");
  fields("yaw_deg", yaw_deg, {-360, 360}, "Direction of its width in the world's frame; 0 along x, 90 along y.");
  fields("width_m", width_m, {0.1, 20}, "Width of the door.");
  fields("height_m", height_m, {0.1, 20}, "Height of the door over the floor of the first vehicle's start.");
  fields("thickness_m", thickness_m, {0.01, 2}, "Thickness of the door.");
  fields("closed_s", closed_s, {0, 1e6},
         "Times at which the door closes, opens, closes and so on; before the first it is open. It waits until no "
         "vehicle is within 0.5 m.");
  fields("closed_share", closed_share, {0, 1}, "Share of the seeds in which it is closed all the time.");
}

std::vector<common::Problem> DoorConfig::validate() const {
  const bool rises =
      std::adjacent_find(closed_s.begin(), closed_s.end(), std::greater_equal<double>()) == closed_s.end();
  return common::Validation()
      .require(!name.empty(), "name", Message("door.no-name", "is missing"))
      .require(!closed_s.empty() || closed_share > 0.0, "closed_s",
               Message("door.never-closes", "is empty: when does the door close?"))
      .require(rises, "closed_s", Message("door.not-in-order", "is not in the order of time"))
      .problems();
}

Door::Door(const DoorConfig& config, double floor_world_m) : config_(config) {
  actor_.position_world_m = {config.x_m, config.y_m};
  actor_.radius_m = 0.0;
  actor_.bottom_m = floor_world_m;
  actor_.top_m = floor_world_m + config.height_m;
  actor_.color = {0.45F, 0.3F, 0.18F};  // Wood.
  actor_.half_size_m = {0.5 * config.width_m, 0.5 * config.thickness_m};
  actor_.yaw_rad = config.yaw_deg * common::kRadPerDeg;
}

void Door::step(common::Time now, std::span<const Actor> hulls) {
  const bool should = shouldBeClosed(now.seconds());
  is_closed_ = should && (is_closed_ || hasRoom(hulls));
}

/// After an odd number of the times.
bool Door::shouldBeClosed(double now_s) const {
  const auto passed = std::upper_bound(config_.closed_s.begin(), config_.closed_s.end(), now_s);
  return (passed - config_.closed_s.begin()) % 2 == 1;
}

bool Door::hasRoom(std::span<const Actor> hulls) const {
  return std::all_of(hulls.begin(), hulls.end(), [this](const Actor& hull) {
    const Eigen::Vector2d& at = hull.position_world_m;
    return (nearestWithin(actor_, at) - at).norm() - hull.radius_m >= kRoom_m;
  });
}

}  // namespace swiftlet::simulation
