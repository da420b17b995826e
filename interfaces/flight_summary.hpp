// One flight in figures and words: what mission.json keeps and report.html shows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/build_version.hpp"
#include "common/localization.hpp"
#include "common/machine_use.hpp"
#include "common/time.hpp"
#include "common/world/frontier.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"

namespace swiftlet::interfaces {

enum class Outcome {
  kFlying,   ///< Not over. In the files of a run that is over: the process was killed.
  kDone,     ///< The mission succeeded.
  kFailed,   ///< The mission failed; the reason says why.
  kCrashed,  ///< Something was touched.
  kStopped,  ///< Ended from outside: by the operator, a time limit, or a full disk.
};
const char* toString(Outcome outcome);

/// A text file of a run.
struct RunText {
  std::string file;
  std::string text;
};

/// Facts that are known before the flight.
struct RunInfo {
  std::string mission;       ///< Name of the mission, for titles and folders.
  std::string mission_file;  ///< As given by the user.
  std::string world;
  std::string system;  ///< Name of the profile.
  std::int64_t seed = 0;
  common::BuildVersion version = {};
  std::string started;                   ///< Local date and time; the caller's clock.
  std::string vehicle = {};              ///< Name of the vehicle among several; empty: it flew alone.
  std::string nature = {};               ///< Name of the simulator's nature; empty: it flew in no simulator.
  std::string nature_yaml = {};          ///< The values drawn from that nature; empty: no value is drawn.
  std::vector<RunText> sheets = {};      ///< Data sheets that the settings name and that are not shipped.
  std::string vehicle_memory_yaml = {};  ///< What earlier flights have learned of the vehicle; empty: no memory.
};

/// A stretch of the flight in which one thing flew the vehicle, with one intent.
struct Phase {
  std::string name;
  common::Time begin;
  common::Time end;
  std::string flown_by = "mission";  ///< Or "operator", "supervisor", "pilot".
  std::string reason = {};           ///< At its begin, where it is not the mission's own; else empty.
};

/// A named figure of a flight. The name ends in the unit: goal_error_m.
struct Figure {
  std::string name;
  double value = 0.0;
};

/// The state of the flight a few times a second, for plots.
struct FlightSample {
  double time_s = 0.0;
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();
  double speed_m_s = 0.0;  ///< Horizontal speed.
  double height_above_ground_m = 0.0;
  double battery_v = 0.0;
  double explored_area_m2 = 0.0;  ///< 0 until the first Explore.
  double nearest_m = 0.0;         ///< Distance from the hull to the nearest return; may be infinite.
};

/// How the flight localized in the map it was given, by its own estimate.
struct LocalizationSummary {
  std::string map;  ///< The file of the map that was given last.
  common::Localization last;
  std::optional<double> found_after_s;  ///< Time until it first reported a pose.
  std::optional<double> found_after_m;  ///< Path length until it first reported a pose.
  double flown_s = 0.0;                 ///< Length of the flight.
  double localized_s = 0.0;             ///< Part of the flight in which it was localized.
};

struct FlightSummary {
  RunInfo info;
  Outcome outcome = Outcome::kFlying;
  std::string reason;
  common::Duration mission_time;           ///< From the first tick of the mission to its end.
  double distance_m = 0.0;                 ///< Path length by the estimate.
  std::optional<double> explored_area_m2;  ///< nullopt if the mission did not explore.
  double battery_remaining = 1.0;
  std::optional<double> coverage;  ///< Share of the reachable free space in [0, 1]; nullopt if the truth is not known.
  std::optional<LocalizationSummary> localization;  ///< nullopt without a given map.
  std::vector<Phase> phases;
  std::optional<double> octree_age_s;  ///< How much older map.bt and map.ot are than the summary; nullopt without them.
  std::vector<common::Frontier> frontiers;        ///< The frontiers that remained, each with its reason.
  std::vector<common::Target> targets;            ///< What the camera has found of those that it looked for.
  std::vector<common::RecognizedObject> objects;  ///< What the camera has recognized, candidates included.
  std::vector<Figure> figures;
  std::vector<FlightSample> samples;
  std::optional<double> wall_time_s;      ///< Computing time.
  std::optional<double> realtime_factor;  ///< Flown time over wall_time_s, from start to end.
  common::MachineUse machine;
};

/// mission.json, indented. Figures have at most four decimals; those that are not finite, or not known, are null.
std::string toJson(const FlightSummary& summary);
/// objects.json: what was recognized, with its pose in `map` and its covariance.
std::string objectsJson(const std::vector<common::RecognizedObject>& objects);

}  // namespace swiftlet::interfaces
