// Records, by the truth, how well the vehicle did what some behaviours promise: keeping out of zones, looking at the
// point it inspects, seeing all of the area it surveys or explores, and staying behind the person it follows.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/occupancy_grid.hpp"
#include "common/polygon.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct Map3dLayer;
struct World;
}  // namespace swiftlet::common

namespace swiftlet::evaluation {

struct BehaviorRecord {
  /// Where the vehicle truly was while it inspected a point.
  struct View {
    common::Pose3 T_world_body;
    Eigen::Vector2d point_map_m;
    std::optional<double> point_height_m;  ///< Above the take-off floor; nullopt: not known.
  };

  /// How a person was followed in one flight mode, from when the vehicle was first at the right distance.
  struct Follow {
    common::FlightMode mode = common::FlightMode::kFast;
    double followed_s = 0.0;
    double in_distance_s = 0.0;  ///< Part of it with the person 1.5 to 3 m from the vehicle's centre.
    double nearest_m = 0.0;
    double farthest_m = 0.0;
    double lost_s = 0.0;  ///< Longest time in which the estimated person was more than 1 m from the truth.

    /// docs/decisions/following.md#064, "Measured".
    static constexpr double kNear_m = 1.5, kFar_m = 3.0, kWrong_m = 1.0;
  };

  /// What the map was when an exploration ended as a success, and where the vehicle and the doors truly were.
  struct Explored {
    common::ExploreIntent asked;
    std::shared_ptr<const common::OccupancyGrid> map;  ///< Null before the first snapshot.
    std::shared_ptr<const common::Map3dLayer> map3d;   ///< Null without one.
    std::shared_ptr<const std::vector<common::Polygon>> keep_out;
    double height_world_m = 0.0;
    std::vector<simulation::Actor> closed_doors;
  };

  /// Least distance of the true centre of the airborne vehicle from a keep-out zone, negative inside; from when it was
  /// first outside of that zone. nullopt without a zone.
  std::optional<double> keep_out_distance_m;
  std::vector<View> inspecting;           ///< At 10 Hz.
  std::vector<common::Polygon> surveyed;  ///< The areas whose survey succeeded.
  std::vector<Explored> explored;
  std::vector<Follow> follows;                          ///< In order of time; empty if no person was followed.
  std::shared_ptr<const common::TargetsLayer> targets;  ///< The last; null before the first snapshot.
  std::shared_ptr<const common::ObjectsLayer> objects;  ///< The last; null if nothing is recognized.
};

/// Called by the FlightRecorder, whose functions have the same names. Calls come in the order of time.
class BehaviorRecorder {
 public:
  /// The true places of the people; the first one is the person to be followed.
  void people(std::vector<Eigen::Vector2d> people_world_m) { people_world_m_ = std::move(people_world_m); }
  /// `T_map_truth` is the true pose in the vehicle's `map` frame.
  void tick(const simulation::Truth& truth, const common::Pose3& T_map_truth, const common::Pose3& T_world_map);
  void intent(const common::Intent& intent, const common::IntentStatus& status);
  void world(const common::World& world);

  const BehaviorRecord& record() const { return record_; }

 private:
  void keepOut(const Eigen::Vector2d& position_map_m);
  void inspect(const simulation::Truth& truth);
  void follow(const simulation::Truth& truth, const common::Pose3& T_world_map, double elapsed_s);

  BehaviorRecord record_;
  BehaviorRecord::Explored present_;  ///< If an exploration ended now.
  std::shared_ptr<const std::vector<common::Polygon>> zones_;
  std::vector<common::Polygon> left_;  ///< The zones that the vehicle has been outside of since they were made.
  common::Intent intent_;
  common::IntentStatus status_;
  std::vector<Eigen::Vector2d> people_world_m_;
  std::optional<Eigen::Vector2d> followed_map_m_;
  std::optional<common::Time> last_tick_;
  common::Time next_view_;
  double lost_now_s_ = 0.0;
};

}  // namespace swiftlet::evaluation
