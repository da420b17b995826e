// The descent onto a landing pattern that is seen below (Tomic 2012, section "Mission"): position-based visual
// servoing, in which the reference follows the tracked place of the pattern at each step.
//
//   fly over its middle --centred--> descend --low enough--> land
//            ^-- blown off, or it is seen to be elsewhere --/
//
// From the last half metre the pattern fills more than the picture: the place that was known then is landed on.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "autonomy/maneuvers/maneuver_input.hpp"
#include "common/geometry.hpp"
#include "common/hysteresis.hpp"
#include "common/world/objects_layer.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// One thread. For a vehicle that flies, knows its position and does not retreat.
class PatternDescent {
 public:
  enum class Status { kFlies, kLowEnough, kKeptOff };

  explicit PatternDescent(const common::RecognizedObject& pattern)
      : id_(pattern.id), name_(pattern.what), place_map_m_(pattern.T_map_object.position_m) {}

  /// The nearest confirmed pattern that lies flat and within half a metre below the vehicle; nullopt without one.
  static std::optional<common::RecognizedObject> below(const ManeuverInput& input);

  /// To be called at each step, until it is low enough.
  Status step(const ManeuverInput& input, control::FlightController& controller);
  /// Follows the pattern's place only; a pattern that is not known any more stays where it was.
  void track(const ManeuverInput& input);

  const std::string& name() const { return name_; }
  Eigen::Vector2d middle_map_m() const { return place_map_m_.head<2>(); }
  double off_m(const ManeuverInput& input) const { return (middle_map_m() - input.position_map_m()).norm(); }

 private:
  static constexpr double kNear_m = 0.5;
  static constexpr double kFlat_rad = 15.0 * common::kRadPerDeg;  ///< What stands or leans carries no vehicle.
  /// Over the middle: the vehicle sways by a few centimetres in a hover.
  static constexpr double kOverMiddle_m = 0.06, kOverMiddle_m_s = 0.15, kOverMiddle_s = 0.4;
  static constexpr double kOffMiddle_m = 0.2;     ///< Farther off it first flies back over the middle.
  static constexpr double kCorrection_m = 0.015;  ///< Less is within the noise of the place.
  /// Height of the body over the pattern at which the landing takes over: paths keep that much air below the hull
  /// (SurfaceClearance), by which they may be lifted.
  static constexpr double kLandsFrom_m = 0.5, kLifted_m = 0.12;
  /// From the height of a room, with time to be blown off.
  static constexpr double kPatience_s = 40.0;

  void begin(const ManeuverInput& input, const control::FlightController& controller);
  void follow(const ManeuverInput& input, control::FlightController& controller);

  int id_;
  std::string name_;
  Eigen::Vector3d place_map_m_;
  bool descends_ = false;
  double over_map_m_ = 0.0;  ///< The height at which it flies over the pattern.
  std::optional<common::Time> since_;
  std::optional<Eigen::Vector3d> flown_map_m_;  ///< The end of the path that is flown.
  common::Hysteresis over_middle_{kOverMiddle_s};
};

inline std::optional<common::RecognizedObject> PatternDescent::below(const ManeuverInput& input) {
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

inline void PatternDescent::track(const ManeuverInput& input) {
  if (!input.objects) return;
  const auto& objects = input.objects->objects;
  const auto found = std::find_if(objects.begin(), objects.end(), [this](const auto& one) { return one.id == id_; });
  if (found != objects.end()) place_map_m_ = found->T_map_object.position_m;
}

inline void PatternDescent::begin(const ManeuverInput& input, const control::FlightController& controller) {
  descends_ = false;
  over_map_m_ = controller.follower().reference().position_odom_m.z();
  flown_map_m_.reset();
  over_middle_.update(false, input.now);
}

/// The beams down know better than the camera how high the vehicle is over the pattern.
inline PatternDescent::Status PatternDescent::step(const ManeuverInput& input, control::FlightController& controller) {
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
inline void PatternDescent::follow(const ManeuverInput& input, control::FlightController& controller) {
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
