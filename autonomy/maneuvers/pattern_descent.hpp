// The descent onto a landing pattern that is seen below (Tomic 2012, section "Mission"): position-based visual
// servoing, in which the reference follows the tracked place of the pattern at each step.
//
//   fly over its middle --centred--> descend --low enough--> land
//            ^-- blown off, or it is seen to be elsewhere --/
//
// From the last half metre the pattern fills more than the picture: the place that was known then is landed on.
#pragma once

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

}  // namespace swiftlet::autonomy
