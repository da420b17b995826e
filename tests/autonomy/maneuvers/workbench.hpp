// Support for tests of single parts of maneuvers: a vehicle in flight that only the test moves, and a planning desk
// whose answers come when the test says so.
#pragma once

#include <vector>

#include "autonomy/maneuvers/path_flight.hpp"
#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {

class ManeuverWorkbench : public ManeuverInFlight {
 protected:
  void SetUp() override {
    ManeuverInFlight::SetUp();  // The executor's intent is done: it no longer uses the controller.
    memory_.cruise_height_m = kHeight_m;
    look();
  }

  /// The desk's cost map is that of the grid.
  void look() {
    desk_.ask(planningRequest(input(), setup_.client), now_);
    deliver();
  }
  void deliver() { desk_jobs_->deliverDue(now_ + common::Duration::fromSeconds(1.0)); }

  static planning::Path straight(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) {
    const double length_m = (to_map_m - from_map_m).norm();
    return {{from_map_m, to_map_m}, length_m, length_m};
  }
  /// The last event since the last call.
  common::Event lastEvent() {
    const std::vector<common::Event> events = memory_log_.take();
    return events.empty() ? common::Event{{}, {}, {}, "nothing", {}} : events.back();
  }

  std::unique_ptr<common::JobRunner> desk_jobs_ = common::makeLockstepJobs(0);
  std::vector<PlanningAnswer> answers_;
  ExecutorConfig config_;
  PlanningDesk desk_{config_.planning, {}, 0.05, *desk_jobs_, [this](const PlanningAnswer& answer, common::Time) {
                       answers_.push_back(answer);
                     }};
  RetreatFlight retreat_{controller_};
  common::EventLog memory_log_;
  FlightMemory memory_{memory_log_};
  ManeuverSetup setup_{config_, controller_, desk_, retreat_, memory_, {7, 0.10}};
};

}  // namespace swiftlet::autonomy
