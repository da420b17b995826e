#include "simulation/sensors/event_queue.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "simulation/sensors/sensor_faults.hpp"

namespace swiftlet::simulation {

using common::SensorEvent;

EventQueue::EventQueue(const Scenario& scenario, const FaultSchedule& faults, std::uint64_t seed)
    : faults_(faults), laser_(scenario.laser) {
  const SensorsConfig& sensors = scenario.sensors;
  const std::array<const LinkConfig*, kSensorCount> configs{
      &sensors.imu_link,    &sensors.laser_link, &sensors.battery_link,       &sensors.pilot_link,
      &sensors.camera_link, &sensors.rgbd_link,  &sensors.vertical_laser_link};
  for (int i = 0; i < kSensorCount; ++i)
    links_.emplace_back(*configs[static_cast<std::size_t>(i)], seed, toString(static_cast<Sensor>(i)));
}

void EventQueue::send(Sensor sensor, std::uint64_t frame, common::Time ready, SensorEvent event) {
  const auto index = static_cast<std::size_t>(sensor);
  auto arrived = links_[index].arrival(frame, ready);
  if (!arrived) return;
  const common::Time measured = stampsOf(event).measured;
  event = restamped(std::move(event), {measured, *arrived});
  if (const auto fault = faults_.of(sensor, measured)) {
    auto faulty = withFault(*fault, event, last_good_[index], laser_);
    if (!faulty) return;
    event = std::move(*faulty);
  } else {
    last_good_[index] = event;
  }
  under_way_.push_back({stampsOf(event).arrived, sensor, frame, std::move(event)});
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
