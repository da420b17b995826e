#include "autonomy/maneuvers/pattern_descent.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {

std::optional<common::RecognizedObject> PatternDescent::below(const ManeuverInput& input) {
  std::optional<common::RecognizedObject> nearest;
  if (!input.objects) return nearest;
  double nearest_m = kNear_m;
  for (const common::RecognizedObject& object : input.objects->objects) {
    const bool is_pattern = object.confirmed && object.passage == common::Passage::kNone && object.what != "mirror";
    const double upright = (object.T_map_object.rotation * Eigen::Vector3d::UnitZ()).z();
    const double away_m = (object.T_map_object.position_m.head<2>() - input.position_map_m()).norm();
    if (!is_pattern || upright < std::cos(kFlat_rad) || away_m > nearest_m) continue;
    nearest = object;
    nearest_m = away_m;
  }
  return nearest;
}

void PatternDescent::track(const ManeuverInput& input) {
  const common::RecognizedObject* found = input.objects ? input.objects->withId(id_) : nullptr;
  if (found != nullptr) place_map_m_ = found->T_map_object.position_m;
}

void PatternDescent::begin(const ManeuverInput& input, const control::FlightController& controller) {
  descends_ = false;
  over_map_m_ = controller.follower().reference().position_odom_m.z();
  flown_map_m_.reset();
  over_middle_.update(false, input.now);
}

/// The beams down know better than the camera how high the vehicle is over the pattern.
PatternDescent::Status PatternDescent::step(const ManeuverInput& input, control::FlightController& controller) {
  track(input);
  if (!since_) {
    since_ = input.now;
    begin(input, controller);
  }
  const double speed_m_s = input.state.velocity_odom_m_s.head<2>().norm();
  over_middle_.update(off_m(input) < kOverMiddle_m && speed_m_s < kOverMiddle_m_s, input.now);
  if (descends_ && off_m(input) > kOffMiddle_m) begin(input, controller);
  descends_ = descends_ || over_middle_.active();
  const double over_m =
      std::min(input.state.T_map_body().position_m.z() - place_map_m_.z(), input.state.height_above_ground_m);
  if (descends_ && off_m(input) < kOverMiddle_m && over_m < kLandsFrom_m + kLifted_m) return Status::kLowEnough;
  if ((input.now - *since_).seconds() > kPatience_s) return Status::kKeptOff;
  follow(input, controller);
  return Status::kFlies;
}

/// A path that is no longer followed, as after a retreat, is laid again.
void PatternDescent::follow(const ManeuverInput& input, control::FlightController& controller) {
  Eigen::Vector3d end_map_m = place_map_m_;
  end_map_m.z() = descends_ ? place_map_m_.z() + kLandsFrom_m : over_map_m_;
  const bool under_way = flown_map_m_ && controller.follower().followsPath();
  if (under_way && (*flown_map_m_ - end_map_m).norm() < kCorrection_m) return;
  const Eigen::Vector3d from_odom_m = controller.follower().reference().position_odom_m;
  const Eigen::Vector2d from_map_m = input.state.T_map_odom * Eigen::Vector2d(from_odom_m.head<2>());
  control::FlightPath path;
  path.mode = common::FlightMode::kAccurate;
  path.points_map_m = {{from_map_m.x(), from_map_m.y(), from_odom_m.z()}, end_map_m};
  path.goal_yaw_map_rad = input.state.T_map_body_planar().yaw_rad;
  if (controller.follow(path)) flown_map_m_ = end_map_m;
}

}  // namespace swiftlet::autonomy
