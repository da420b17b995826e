#include "simulation/sensors/sensor_faults.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "simulation/sensors/picture_faults.hpp"

namespace swiftlet::simulation {
namespace {

using common::SensorEvent;
using Scan = std::shared_ptr<const common::LaserScan>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kNoReturn_m = 0.0F;  ///< The error code of the laser.

template <typename Held>
struct IsShared : std::false_type {};
template <typename Value>
struct IsShared<std::shared_ptr<const Value>> : std::true_type {};

struct MakeNan {
  SensorEvent operator()(common::ImuSample sample) const {
    sample.angular_velocity_body_rad_s.setConstant(kNan);
    sample.specific_force_body_m_s2.setConstant(kNan);
    sample.rotation_ahrs_body.coeffs().setConstant(kNan);
    return sample;
  }
  template <typename AnyScan>
  requires std::is_base_of_v<common::LaserScan, AnyScan> SensorEvent
  operator()(const std::shared_ptr<const AnyScan>& scan) const {
    auto copy = std::make_shared<AnyScan>(*scan);
    std::fill(copy->ranges_m.begin(), copy->ranges_m.end(), std::numeric_limits<float>::quiet_NaN());
    return std::shared_ptr<const AnyScan>(std::move(copy));
  }
  SensorEvent operator()(common::BatterySample sample) const {
    sample.voltage_v = sample.remaining = sample.current_a = kNan;
    return sample;
  }
  SensorEvent operator()(common::PilotSample sample) const {
    sample.roll = sample.pitch = sample.yaw_rate = sample.thrust = kNan;
    return sample;
  }
  /// A picture cannot hold NaN, so it becomes black.
  SensorEvent operator()(const std::shared_ptr<const common::CameraFrame>& frame) const {
    auto copy = std::make_shared<common::CameraFrame>(*frame);
    std::fill(copy->image.rgb.begin(), copy->image.rgb.end(), std::uint8_t{0});
    return std::shared_ptr<const common::CameraFrame>(std::move(copy));
  }
  SensorEvent operator()(const std::shared_ptr<const common::RgbdFrame>& frame) const {
    auto copy = std::make_shared<common::RgbdFrame>(*frame);
    std::fill(copy->color.rgb.begin(), copy->color.rgb.end(), std::uint8_t{0});
    std::fill(copy->depth.depth_m.begin(), copy->depth.depth_m.end(), std::numeric_limits<float>::quiet_NaN());
    return std::shared_ptr<const common::RgbdFrame>(std::move(copy));
  }
};

SensorEvent withStuckAttitude(common::ImuSample sample, const std::optional<SensorEvent>& last_good) {
  const auto* good = last_good ? std::get_if<common::ImuSample>(&*last_good) : nullptr;
  if (good != nullptr) sample.rotation_ahrs_body = good->rotation_ahrs_body;
  return sample;
}

SensorEvent withBias(common::ImuSample sample, const FaultConfig& fault) {
  sample.angular_velocity_body_rad_s.array() += fault.gyro_bias_deg_s * common::kRadPerDeg;
  sample.specific_force_body_m_s2.array() += fault.accel_bias_m_s2;
  return sample;
}

template <typename IsLost>
SensorEvent without(const Scan& scan, IsLost is_lost) {
  auto copy = std::make_shared<common::LaserScan>(*scan);
  for (std::size_t beam = 0; beam < copy->ranges_m.size(); ++beam)
    if (is_lost(static_cast<int>(beam))) copy->ranges_m[beam] = kNoReturn_m;
  return Scan(std::move(copy));
}

}  // namespace

SensorEvent restamped(SensorEvent event, const common::Stamps& stamps) {
  std::visit(
      [&stamps](auto& held) {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (IsShared<Held>::value) {
          auto copy = std::make_shared<std::remove_const_t<typename Held::element_type>>(*held);
          copy->stamps = stamps;
          held = std::move(copy);
        } else {
          held.stamps = stamps;
        }
      },
      event);
  return event;
}

std::optional<SensorEvent> withFault(const ActiveFault& active, const SensorEvent& event,
                                     const std::optional<SensorEvent>& last_good, const common::LaserConfig& laser) {
  const FaultConfig& fault = active.config;
  common::Stamps stamps = stampsOf(event);
  switch (fault.kind) {
    case FaultKind::kSilent:
      return std::nullopt;
    case FaultKind::kNan:
      return std::visit(MakeNan{}, event);
    case FaultKind::kRepeat:
      return last_good ? restamped(*last_good, stamps) : event;
    case FaultKind::kLate:
      stamps.arrived += common::Duration::fromSeconds(fault.late_s);
      return restamped(event, stamps);
    case FaultKind::kClockJump:
      stamps.measured += common::Duration::fromSeconds(fault.jump_s);
      return restamped(event, stamps);
    case FaultKind::kClockDrift:
      stamps.measured += common::Duration::fromSeconds(fault.drift_s_s * (stamps.measured - active.begin).seconds());
      return restamped(event, stamps);
    case FaultKind::kStuck:
      return withStuckAttitude(std::get<common::ImuSample>(event), last_good);
    case FaultKind::kBias:
      return withBias(std::get<common::ImuSample>(event), fault);
    case FaultKind::kMirror:
      return without(std::get<Scan>(event), [&](int beam) { return laser.isMirrorBeam(beam); });
    case FaultKind::kBlocked:
      return without(std::get<Scan>(event), [&](int beam) {
        const double angle_deg = (laser.angleMin_rad() + beam * laser.angleIncrement_rad()) / common::kRadPerDeg;
        return !laser.isMirrorBeam(beam) && angle_deg >= fault.from_deg && angle_deg <= fault.to_deg;
      });
    case FaultKind::kBlack:
    case FaultKind::kWhite:
    case FaultKind::kFlipped:
    case FaultKind::kOtherSize:
    case FaultKind::kExchanged:
    case FaultKind::kOneSided:
      return withPictureFault(fault.kind, event);
    case FaultKind::kLostCell:  // Of the battery itself.
      return event;
  }
  return event;
}

}  // namespace swiftlet::simulation
