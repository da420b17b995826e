// Carries out one Intent at a time: asks for plans (as jobs), keeps them while they are good, hands paths to the flight
// controller, and says how it stands. The reactive layer's retreat comes before everything the intent wants.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/planning_worker.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/intent.hpp"
#include "common/jobs.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/frontier.hpp"
#include "control/flight_controller.hpp"
#include "planning/avoidance/avoidance.hpp"
#include "planning/search/plan_keeper.hpp"

namespace swiftlet::autonomy {

struct ExecutorConfig {
  planning::CostMap::Config cost_map;
  planning::ExplorationConfig exploration;
  planning::PlanKeeper::Config plan_keeper;
  double planning_latency_s = 0.06;
  double planning_period_s = 0.25;
  double explore_period_s = 0.5;
  double clearance_m = 0.10;
  double arrival_speed_m_s = 0.15;
  double arrival_s = 0.25;
  double viewpoint_tolerance_m = 0.15;
  double viewpoint_tolerance_deg = 12.0;
  double give_up_s = 60.0;
  double detour_after_s = 2.5;
  double detour_s = 15.0;

  void describe(common::config::Fields& fields);
};

/// What the executor sees of the world at one tick.
struct ExecutorInput {
  common::Time now;
  common::VehicleState state;
  std::shared_ptr<const common::OccupancyGrid> grid;
  std::shared_ptr<const common::LevelMap> levels;
  std::vector<planning::Disc> discs;
  bool anybody_walks = false;
  const planning::AvoidanceDecision& avoidance;
};

/// One thread. tick() at the behaviours' rate; react() at the laser rate.
class Executor {
 public:
  Executor(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
           control::FlightController& controller, common::JobRunner& jobs);

  /// The intent from now on; the same id goes on with what is under way.
  void want(const common::Intent& intent);
  void tick(const ExecutorInput& input);
  /// Follows the retreat of the reactive layer, or gives the vehicle back to the intent when there is none.
  void react(const planning::AvoidanceDecision& decision, const common::VehicleState& state);

  const common::IntentStatus& status() const { return status_; }
  /// Along the path being flown; zero when none is.
  Eigen::Vector2d wishedVelocity_map_m_s() const;

  std::shared_ptr<const planning::CostMap> costMap() const { return cost_map_; }
  std::shared_ptr<const std::vector<common::Frontier>> frontiers() const { return frontiers_; }
  std::vector<Eigen::Vector2d> remainingPlan_map_m() const { return keeper_.remaining(); }
  std::optional<Eigen::Vector2d> goal_map_m() const;
  double exploredArea_m2() const { return explored_area_m2_; }
  /// Where the vehicle's centre may be, for judging an operator's goal: the reason it is refused, or none.
  std::optional<std::string> refusalOfGoal(const Eigen::Vector2d& goal_map_m) const;

  std::vector<common::Event> takeEvents();

 private:
  void start();
  void carryOut(const ExecutorInput& input, const common::HoldIntent&);
  void carryOut(const ExecutorInput& input, const common::AvoidIntent&);
  void carryOut(const ExecutorInput& input, const common::TakeOffIntent& take_off);
  void carryOut(const ExecutorInput& input, const common::LandIntent&);
  void carryOut(const ExecutorInput& input, const common::GoToIntent& go_to);
  void carryOut(const ExecutorInput& input, const common::ExploreIntent& explore);

  void requestPlan(const ExecutorInput& input, PlanningRequest request);
  void receive(const PlanningAnswer& answer, common::Time now);
  void receivePath(const tl::expected<planning::Path, planning::PlanFailure>& path);
  void receiveExploration(const planning::ExplorationResult& result);
  static std::optional<Eigen::Vector2d> blockedFrontier(const std::vector<common::Frontier>& frontiers);
  bool keepPlan(const ExecutorInput& input);
  void abandonPlan();
  void endDetourWhenOver(const ExecutorInput& input);
  bool detourIsDue(std::optional<common::Time> stuck_since) const;
  void takeDetour(const ExecutorInput& input, const Eigen::Vector2d& goal_map_m);
  void receiveDetour(const Detour& detour);
  void offer(const planning::Path& path);
  void fly();
  bool arrived(const ExecutorInput& input, const Eigen::Vector2d& goal_map_m, double tolerance_m);
  double clearance_m() const;
  void succeed(std::string reason);
  void fail(std::string reason);
  void say(common::Severity severity, std::string text, std::string reason = {});

  ExecutorConfig config_;
  common::VehicleConfig vehicle_;
  control::FlightController& controller_;
  common::JobRunner& jobs_;
  std::shared_ptr<PlanningWorker> worker_;
  planning::PlanKeeper keeper_;
  std::vector<planning::ExplorationAttempt> attempts_;

  common::Intent intent_;
  bool started_ = false;  ///< The present intent has had its first tick.
  common::IntentStatus status_;
  common::Time now_;
  common::VehicleState state_;
  double cruise_height_m_ = 1.0;
  std::optional<double> goal_yaw_map_rad_;

  std::shared_ptr<const planning::CostMap> cost_map_;
  std::shared_ptr<const std::vector<common::Frontier>> frontiers_;
  double explored_area_m2_ = 0.0;
  std::optional<common::Time> last_request_;
  std::optional<common::Time> last_exploration_;
  std::optional<planning::Viewpoint> viewpoint_;
  std::optional<common::Time> looks_since_;  ///< At the viewpoint, turned as it asks.
  int done_answers_ = 0;                     ///< Explorations in a row that found nothing open.
  std::optional<common::Time> done_since_, last_people_;
  std::optional<Eigen::Vector2d> blocked_frontier_map_m_;  ///< Explored but for this, which somebody may hide.
  std::optional<common::Time> within_since_;
  std::optional<common::Time> no_way_since_;
  planning::PlanFailure no_way_;
  std::optional<common::Time> asked_for_way_;
  std::optional<common::Time> detour_since_;  ///< The last one began, or ended.
  bool on_detour_ = false;
  bool retreating_ = false;
  double retreat_yaw_map_rad_ = 0.0;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
