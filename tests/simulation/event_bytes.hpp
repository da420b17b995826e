// Sensor events as bytes, to compare flights.
#pragma once

#include <string>
#include <vector>

#include "fixtures.hpp"

namespace swiftlet::simulation {

inline void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}
template <typename Value>
void append(std::string& bytes, const Value& value) {
  append(bytes, &value, sizeof value);
}

/// Every number of an event, in order, so that two flights can be compared byte by byte.
inline std::string bytesOf(const common::SensorEvent& event) {
  std::string bytes;
  append(bytes, stampsOf(event).measured.nanoseconds());
  append(bytes, stampsOf(event).arrived.nanoseconds());
  append(bytes, event.index());
  if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
    append(bytes, imu->angular_velocity_body_rad_s.data(), 3 * sizeof(double));
    append(bytes, imu->specific_force_body_m_s2.data(), 3 * sizeof(double));
    append(bytes, imu->rotation_ahrs_body.coeffs().data(), 4 * sizeof(double));
  } else if (const auto* scan = std::get_if<Scan>(&event)) {
    append(bytes, (*scan)->ranges_m.data(), (*scan)->ranges_m.size() * sizeof(float));
  } else if (const auto* sweep = std::get_if<Sweep>(&event)) {
    append(bytes, (*sweep)->ranges_m.data(), (*sweep)->ranges_m.size() * sizeof(float));
  } else if (const auto* battery = std::get_if<common::BatterySample>(&event)) {
    append(bytes, battery->voltage_v);
    append(bytes, battery->remaining);
    append(bytes, battery->current_a);
  } else if (const auto* frame = std::get_if<Frame>(&event)) {
    append(bytes, (*frame)->image.rgb.data(), (*frame)->image.rgb.size());
  } else if (const auto* rgbd = std::get_if<Rgbd>(&event)) {
    append(bytes, (*rgbd)->color.rgb.data(), (*rgbd)->color.rgb.size());
    append(bytes, (*rgbd)->depth.depth_m.data(), (*rgbd)->depth.depth_m.size() * sizeof(float));
  }
  return bytes;
}
inline std::string bytesOf(const std::vector<common::SensorEvent>& events, bool with_camera) {
  std::string bytes;
  for (const auto& event : events)
    if (with_camera || !std::holds_alternative<Frame>(event)) bytes += bytesOf(event);
  return bytes;
}

}  // namespace swiftlet::simulation
