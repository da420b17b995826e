// Ports that several behaviours share, so that they mean the same in all of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "behaviors/tree/port.hpp"
#include "common/flight_mode.hpp"
#include "common/polygon.hpp"

namespace swiftlet::behaviors {

inline tree::PortManifest clearancePort() {
  return {.name = "clearance_m",
          .type = tree::PortType::kDouble,
          .default_value = "0.10",
          .minimum = 0.0,
          .maximum = 5.0,
          .description = "Between the hull and what is in the map."};
}

inline tree::PortManifest tolerancePort() {
  return {.name = "tolerance_m",
          .type = tree::PortType::kDouble,
          .default_value = "0.05",
          .minimum = 0.01,
          .maximum = 5.0,
          .description =
              "Arrived when nearer to the goal than this; where the goal is not free, a free place within 0.8 "
              "of this distance will do."};
}

inline tree::PortManifest shiftPort() {
  return {.name = "shift_m",
          .type = tree::PortType::kDouble,
          .default_value = "0.25",
          .minimum = 0.0,
          .maximum = 5.0,
          .description =
              "Where the goal is not free for some seconds, the nearest free place within this distance will do."};
}

inline tree::PortManifest headingPort(bool required) {
  return {.name = "yaw_deg",
          .type = tree::PortType::kDouble,
          .required = required,
          .minimum = -360.0,
          .maximum = 360.0,
          .description = std::string("Heading in the map frame, counter-clockwise; 0 is that of the take-off, or the x "
                                     "axis of the given map.") +
                         (required ? "" : " Not given: any.")};
}

/// A place that must be given.
inline tree::PortManifest placePort(std::string name) {
  return {.name = std::move(name),
          .type = tree::PortType::kPoint,
          .required = true,
          .description =
              "In the map frame, whose origin is the take-off pose, or in the given map; z above the take-off floor."};
}

/// An area that must be given; `purpose` completes "the area ...".
inline tree::PortManifest polygonPort(const std::string& purpose) {
  return {.name = "polygon",
          .type = tree::PortType::kPoints,
          .required = true,
          .description = "Corners, in order, of the area " + purpose +
                         ", in the map frame, whose origin is the take-off pose, or in the given map; a z is ignored."};
}
inline common::Polygon polygonOf(const tree::Points& points) {
  common::Polygon polygon;
  for (const tree::Point& point : points.points) polygon.corners_map_m.emplace_back(point.x, point.y);
  return polygon;
}

/// A port that takes the names of `values`; chosenOf() reads it.
template <typename Enum, std::size_t N>
tree::PortManifest choicePort(const std::string& name, const std::array<Enum, N>& values,
                              const std::string& description) {
  tree::PortManifest port{.name = name,
                          .type = tree::PortType::kString,
                          .default_value = toString(values.front()),
                          .description = description};
  for (const Enum value : values) port.choices.emplace_back(toString(value));
  return port;
}
/// The value of a text of that port, which is one of the names.
template <typename Enum, std::size_t N>
Enum chosenOf(const std::array<Enum, N>& values, const std::string& text) {
  return *std::find_if(values.begin(), values.end() - 1, [&](Enum value) { return text == toString(value); });
}

/// Without a default: see modeOr().
inline tree::PortManifest modePort() {
  tree::PortManifest port = choicePort("mode", common::kFlightModes,
                                       "How fast and how closely the path is flown. Not given: as SetFlightMode says, "
                                       "at first fast.");
  port.default_value.reset();
  return port;
}
/// The mode that the port names, or the present one; nothing if the port is given and has no value.
inline std::optional<common::FlightMode> modeOr(const tree::Input<std::string>& port, common::FlightMode present) {
  if (!port.given()) return present;
  const auto text = port.get();
  return text ? std::optional(chosenOf(common::kFlightModes, *text)) : std::nullopt;
}

/// The name of a file that the run gets.
inline tree::PortManifest fileNamePort(std::string default_name) {
  return {.name = "file",
          .type = tree::PortType::kString,
          .default_value = std::move(default_name),
          .description = "Part of the file's name: letters, digits, - and _, at most 40."};
}
/// Nothing if it can be part of a file's name.
inline std::optional<tree::Message> fileNameProblem(std::string_view name) {
  const bool good = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (good && !name.empty() && name.size() <= 40) return std::nullopt;
  return tree::Message("mission.file-name", "`{}` cannot name a file, expected letters, digits, - and _, at most 40",
                       name);
}

}  // namespace swiftlet::behaviors
