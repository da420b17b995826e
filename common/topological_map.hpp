// A topological map: places with names, passages between free areas, and danger zones (Tomic 2012, section "Mission").
// A run writes one (topological_map.yaml), and a mission names what is in one that its flight is given.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/passage.hpp"

namespace swiftlet::common {

/// The frame of all its coordinates.
enum class PlacesFrame {
  kMap,    ///< `map` of the flight that wrote it: that of the map.yaml beside it.
  kGiven,  ///< `given`: that of the map that the flight was given.
};

/// A place that a mission named, or a pattern that was recognized.
struct MapPlace {
  std::string name = {};
  std::string what = {};
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double yaw_deg = 0.0;
  double sigma_m = 0.0;

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;
};

/// A window or a door.
struct MapPassage {
  std::string name = {};
  std::string what = {};
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double normal_deg = 0.0;
  double width_m = 0.0, height_m = 0.0;
  double sigma_m = 0.0;
  Passage state = Passage::kNone;

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;
};

/// An area to keep out of.
struct DangerZone {
  std::string name;
  std::vector<double> corners_m;  ///< x and y of each corner, in order along the edge.

  void describe(config::Fields& fields);
  std::vector<Problem> validate() const;
};

struct TopologicalMap {
  PlacesFrame frame = PlacesFrame::kMap;
  std::vector<MapPlace> places;
  std::vector<MapPassage> passages;
  std::vector<DangerZone> danger_zones;

  void describe(config::Fields& fields);
  /// All names are different.
  std::vector<Problem> validate() const;

  /// Of places, passages and danger zones.
  std::vector<std::string> names() const;
};

/// Throws InputError for a file that is none, with every problem.
TopologicalMap readTopologicalMap(const std::string& file);
/// As YAML that readTopologicalMap reads back to the same values.
std::string toYaml(const TopologicalMap& map);

}  // namespace swiftlet::common
