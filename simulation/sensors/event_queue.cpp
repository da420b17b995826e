#include "simulation/sensors/event_queue.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

namespace swiftlet::simulation {
namespace {

using common::SensorEvent;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename Held>
struct IsShared : std::false_type {};
template <typename Value>
struct IsShared<std::shared_ptr<const Value>> : std::true_type {};

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

struct MakeNan {
  SensorEvent operator()(common::ImuSample sample) const {
    sample.angular_velocity_body_rad_s.setConstant(kNan);
    sample.specific_force_body_m_s2.setConstant(kNan);
    sample.rotation_ahrs_body.coeffs().setConstant(kNan);
    return sample;
  }
  SensorEvent operator()(const std::shared_ptr<const common::LaserScan>& scan) const {
    auto copy = std::make_shared<common::LaserScan>(*scan);
    std::fill(copy->ranges_m.begin(), copy->ranges_m.end(), std::numeric_limits<float>::quiet_NaN());
    return std::shared_ptr<const common::LaserScan>(std::move(copy));
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
};

}  // namespace

EventQueue::EventQueue(const Scenario& scenario, std::uint64_t seed) : faults_(scenario.faults) {
  const SensorsConfig& sensors = scenario.sensors;
  const std::array<const LinkConfig*, kSensorCount> configs{
      &sensors.imu_link, &sensors.laser_link, &sensors.battery_link, &sensors.pilot_link, &sensors.camera_link};
  for (int i = 0; i < kSensorCount; ++i)
    links_.emplace_back(*configs[static_cast<std::size_t>(i)], seed, toString(static_cast<Sensor>(i)));
}

const FaultConfig* EventQueue::activeFault(Sensor sensor, common::Time measured) const {
  for (const FaultConfig& fault : faults_)
    if (fault.sensor == sensor && measured.seconds() >= fault.from_s && measured.seconds() < fault.to_s) return &fault;
  return nullptr;
}

void EventQueue::send(Sensor sensor, std::uint64_t frame, common::Time ready, SensorEvent event) {
  const auto index = static_cast<std::size_t>(sensor);
  auto arrived = links_[index].arrival(frame, ready);
  if (!arrived) return;
  common::Stamps stamps{stampsOf(event).measured, *arrived};
  const FaultConfig* fault = activeFault(sensor, stamps.measured);
  if (fault == nullptr) {
    event = restamped(std::move(event), stamps);
    last_good_[index] = event;
  } else {
    switch (fault->kind) {
      case FaultKind::kSilent:
        return;
      case FaultKind::kNan:
        event = restamped(std::visit(MakeNan{}, event), stamps);
        break;
      case FaultKind::kRepeat:
        if (last_good_[index]) event = *last_good_[index];
        event = restamped(std::move(event), stamps);
        break;
      case FaultKind::kLate:
        stamps.arrived += common::Duration::fromSeconds(fault->late_s);
        event = restamped(std::move(event), stamps);
        break;
    }
  }
  under_way_.push_back({stamps.arrived, sensor, frame, std::move(event)});
}

void EventQueue::take(common::Time until, std::vector<SensorEvent>& events) {
  const auto arrived = std::stable_partition(under_way_.begin(), under_way_.end(),
                                             [until](const Entry& entry) { return entry.arrived > until; });
  std::sort(arrived, under_way_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.arrived, a.sensor, a.frame) < std::tie(b.arrived, b.sensor, b.frame);
  });
  for (auto entry = arrived; entry != under_way_.end(); ++entry) events.push_back(std::move(entry->event));
  under_way_.erase(arrived, under_way_.end());
}

}  // namespace swiftlet::simulation
