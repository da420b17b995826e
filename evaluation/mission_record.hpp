// What the snapshots of a flight tell of its mission, and of its localization in the map that it was given.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "common/geometry.hpp"
#include "common/localization.hpp"
#include "common/time.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

class MissionRecord {
 public:
  /// At every snapshot, in the order of time.
  void world(const common::World& world);

  common::MissionState state = common::MissionState::kReady;
  std::string reason;
  double time_s = 0.0;    ///< From the first tick of the mission to its end, or to the end of the flight.
  int interruptions = 0;  ///< How often a running behaviour was suspended.
  int resumed = 0;        ///< How many of the suspended behaviours resumed later.

 private:
  void followTree(const common::TreeView& tree);

  std::optional<common::Time> begin_;
  std::set<int> suspended_;  ///< Nodes of the tree that are suspended while their parent is not.
};

/// Times are those of snapshots.
class LocalizationRecord {
 public:
  /// When it first reported a pose.
  struct Found {
    common::Time stamp;
    double path_length_m = 0.0;  ///< True horizontal path until then.
    double error_m = 0.0;
    double error_rad = 0.0;
  };

  /// The true pose of the given map.
  explicit LocalizationRecord(const common::Pose2& T_world_given) : T_given_world(T_world_given.inverse()) {}
  /// At every snapshot, in the order of time. `T_world_body` is the true pose at the stamp of its estimate; nullopt if
  /// it is not known.
  void world(const common::World& world, const std::optional<common::Pose3>& T_world_body, double true_distance_m);

  common::Pose2 T_given_world;
  std::optional<Found> found;
  double flown_s = 0.0;
  double localized_s = 0.0;
  double wrong_s = 0.0;  ///< Time localized, but farther from the truth than kWrong_m or more turned than kWrong_rad.
  int times_lost = 0;

  /// The bounds that the criterion `wrong_time_share_max` names.
  static constexpr double kWrong_m = 0.5;
  static constexpr double kWrong_rad = 10.0 * common::kRadPerDeg;

 private:
  common::LocalizationState state_ = common::LocalizationState::kGlobal;
  std::optional<common::Time> last_flown_;
};

}  // namespace swiftlet::evaluation
