#include "autonomy/inertial/inertial_input.hpp"

namespace swiftlet::autonomy {

using common::ImuSample;
using common::Time;

namespace {

/// A contradiction that has lasted this long ends in a landing, while the other sensors hold the vehicle.
constexpr double kLandAfter_s = 1.5;

}  // namespace

/// On the ground a faulty sample goes to the filter as it is, which starts only if it makes sense.
std::optional<ImuSample> InertialInput::take(const ImuSample& sample) {
  watch_.add(sample);
  if (watch_.repeats() || (airborne_ && !watch_.fault(sample.stamps.arrived).empty())) return std::nullopt;
  const ImuSample used = check_.checked(sample);
  const common::Edge edge = contradicted_.update(check_.contradicted(), sample.stamps.measured);
  if (edge == common::Edge::kEntered)
    log_.warn(sample.stamps.arrived, "imu", "inertial samples are replaced", check_.fault());
  if (edge == common::Edge::kLeft) log_.info(sample.stamps.arrived, "imu", "inertial samples trusted again");
  if (used.rotation_ahrs_body.coeffs().allFinite()) substitute_.measured(used);
  return used;
}

std::optional<ImuSample> InertialInput::predicted(Time now) {
  if (!airborne_ || !setpoints_apply_ || watch_.fault(now).empty()) return std::nullopt;
  return substitute_.next(now);
}

std::string InertialInput::mustLandFor(Time now) const {
  return contradicted_.active_s(now) > kLandAfter_s ? check_.fault() : std::string();
}

void InertialInput::flown(const common::Setpoint& setpoint, const InertialContext& context) {
  airborne_ = context.airborne;
  setpoints_apply_ = context.thrust_applies;
  check_.vehicleIs(context);
  substitute_.flown(setpoint, context.thrust_over_hover);
}

}  // namespace swiftlet::autonomy
