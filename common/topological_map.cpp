#include "common/topological_map.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/config.hpp"
#include "common/polygon.hpp"
#include "common/validation.hpp"

namespace swiftlet::common {
namespace {

constexpr config::Bounds kCoordinate{-1e5, 1e5};
constexpr config::Bounds kSize{0.0, 1e3};

/// A mission writes it as {name}.
Validation named(const std::string& name) {
  const bool good = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  Validation validation;
  validation.require(good, "name",
                     Message("places.name", "`{}` is no name of a place, expected letters, digits and _", name));
  return validation;
}

}  // namespace

void MapPlace::describe(config::Fields& fields) {
  fields("name", name, "Name of the place, by which missions ask for it.");
  fields("what", what, "What is there: the name of a pattern, or empty for a place that a mission named.");
  fields("x_m", x_m, kCoordinate, "x of the place.");
  fields("y_m", y_m, kCoordinate, "y of the place.");
  fields("z_m", z_m, kCoordinate, "Height of the place above the take-off floor.");
  fields("yaw_deg", yaw_deg, {-360, 360}, "Heading of what is there.");
  fields("sigma_m", sigma_m, kSize, "Standard deviation of the place; 0 where it was given.");
}

std::vector<Problem> MapPlace::validate() const { return named(name).problems(); }

void MapPassage::describe(config::Fields& fields) {
  fields("name", name, "Name of the passage, by which missions ask for it.");
  fields("what", what, "Kind of the passage: window, door or opening.");
  fields("x_m", x_m, kCoordinate, "x of the middle of the passage.");
  fields("y_m", y_m, kCoordinate, "y of the middle of the passage.");
  fields("z_m", z_m, kCoordinate, "Height of the middle of the passage above the take-off floor.");
  fields("normal_deg", normal_deg, {-360, 360}, "Direction of the normal of the wall, to where it was seen from.");
  fields("width_m", width_m, kSize, "Width of the passage.");
  fields("height_m", height_m, kSize, "Height of the passage.");
  fields("sigma_m", sigma_m, kSize, "Standard deviation of the middle of the passage.");
  fields.choice("state", state, {"none", "open", "closed"}, "Whether it was seen open; none: it is not known.");
}

std::vector<Problem> MapPassage::validate() const { return named(name).problems(); }

void DangerZone::describe(config::Fields& fields) {
  fields("name", name, "Name of the danger zone, by which missions ask for it.");
  fields("corners_m", corners_m, kCoordinate, "x and y of each corner of the danger zone, in order along its edge.");
}

std::vector<Problem> DangerZone::validate() const {
  Validation validation = named(name);
  validation.require(
      corners_m.size() % 2 == 0, "corners_m",
      Message("places.odd-corners", "{} numbers are no corners, each has an x and a y", corners_m.size()));
  Polygon area;
  for (std::size_t i = 0; i + 1 < corners_m.size(); i += 2)
    area.corners_map_m.emplace_back(corners_m[i], corners_m[i + 1]);
  if (const auto problem = problemOf(area))
    validation.require(false, "corners_m", Message("places.polygon", "{}", problem->text()));
  return validation.problems();
}

void TopologicalMap::describe(config::Fields& fields) {
  fields.choice(
      "frame", frame, {"map", "given"},
      "Frame of all coordinates: that of the map.yaml of the same run, or that of the map that the flight was "
      "given.");
  fields.list("places", places, "Places with a name.");
  fields.list("passages", passages, "Windows and doors between free areas.");
  fields.list("danger_zones", danger_zones, "Areas to keep out of.");
}

std::vector<Problem> TopologicalMap::validate() const {
  std::vector<std::string> sorted = names();
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  return Validation()
      .require(twice == sorted.end(), "places",
               Message("config.name-twice", "two are called `{}`", twice == sorted.end() ? "" : *twice))
      .problems();
}

std::vector<std::string> TopologicalMap::names() const {
  std::vector<std::string> names;
  for (const MapPlace& place : places) names.push_back(place.name);
  for (const MapPassage& passage : passages) names.push_back(passage.name);
  for (const DangerZone& zone : danger_zones) names.push_back(zone.name);
  return names;
}

TopologicalMap readTopologicalMap(const std::string& file) { return config::readFile<TopologicalMap>(file); }

std::string toYaml(const TopologicalMap& map) {
  return config::YamlPrinter(config::YamlPrinter::Comments::kNo).print(map);
}

}  // namespace swiftlet::common
