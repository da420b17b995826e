// Support for stories of the maneuvers: the executor, a real flight controller and real planning jobs, a map drawn by
// hand, and a vehicle that is at the controller's reference, or where the test puts it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "autonomy/executor.hpp"
#include "common/jobs.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::IntentState;

inline constexpr double kStanding_m = 0.15, kHeight_m = 1.0;
/// `map` and `odom` differ, so that a frame mistake shows.
inline const common::Pose2 kT_map_odom{0.4, -0.3, 0.5};

/// What a profile may choose.
struct Choices {
  planning::PlannerKind planner = planning::PlannerKind::kDStarLite;
  planning::ExplorerKind explorer = planning::ExplorerKind::kUtility;
};

class ManeuverStory : public testing::Test {
 protected:
  explicit ManeuverStory(const Choices& choices = {})
      : executor_(config(choices), {}, 0.05, controller_, *jobs_, log_) {
    state_.T_map_odom = kT_map_odom;
    state_.horizontal_valid = state_.vertical_valid = true;
    state_.T_odom_body.position_m.z() = kStanding_m;
    place(1.5, 2.0);
  }

  void SetUp() override {
    run(0.01);
    ASSERT_TRUE(controller_.command(control::Prepared{}));
  }

  /// Puts the vehicle there, at rest.
  void place(double x_m, double y_m, double yaw_rad = 0.0) {
    const double z_m = state_.T_odom_body.position_m.z();
    state_.T_odom_body = common::lifted(kT_map_odom.inverse() * common::Pose2{x_m, y_m, yaw_rad}, z_m);
    state_.velocity_odom_m_s.setZero();
  }
  Eigen::Vector2d position_m() const { return state_.T_map_body_planar().position_m(); }
  double distanceTo_m(const Eigen::Vector2d& place_map_m) const { return (place_map_m - position_m()).norm(); }
  /// The end of the path. The test may hold the vehicle elsewhere.
  common::Pose2 reference() const {
    const control::Reference& r = controller_.follower().reference();
    return kT_map_odom * common::Pose2{r.position_odom_m.x(), r.position_odom_m.y(), r.yaw_odom_rad};
  }

  void want(const common::IntentKind& kind) { intent_ = {intent_.id + 1, kind}; }
  /// Goes on with an intent that was interrupted.
  void wantAgain(const common::IntentKind& kind, std::uint64_t resumed_id) {
    intent_ = {intent_.id + 1, kind, resumed_id};
  }
  static common::GoToIntent to(double x_m, double y_m) {
    common::GoToIntent intent;
    intent.goal_map_m = {x_m, y_m};
    return intent;
  }

  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 100.0); ++i) step();
  }
  /// The time it took, or the limit.
  template <typename Condition>
  double runUntil(Condition condition, double limit_s) {
    const common::Time from = now_;
    while (!condition() && (now_ - from).seconds() < limit_s) step();
    return (now_ - from).seconds();
  }
  IntentState runToTheEnd(double limit_s) {
    runUntil([this] { return ended(); }, limit_s);
    return executor_.status().state;
  }
  bool ended() const {
    return executor_.status().id == intent_.id && executor_.status().state != IntentState::kRunning;
  }

  /// Sets the decision of the reactive layer to a retreat from now on, and passes it to the executor.
  void retreat(const Eigen::Vector2d& velocity_level_m_s, double turn_rad = 0.0) {
    decision_.retreat_velocity_level_m_s = velocity_level_m_s;
    decision_.retreat_acceleration_m_s2 = 2.0;
    decision_.turn_rad = turn_rad;
    decision_.status.reason = "a person approaches";
    executor_.react(decision_, state_);
  }
  void calm() {
    decision_ = {};
    decision_.speed_limit_m_s = 1.0;
    executor_.react(decision_, state_);
  }

  // The number of events whose text begins with `text`.
  long timesSaid(const std::string& text) const {
    return std::count_if(events_.begin(), events_.end(),
                         [&](const auto& event) { return event.text.starts_with(text); });
  }
  std::string reasonOf(const std::string& text) const {
    const auto at =
        std::find_if(events_.begin(), events_.end(), [&](const auto& event) { return event.text.starts_with(text); });
    return at == events_.end() ? "never said: " + text : at->reason;
  }

  ManeuverInput input() {
    return {now_,
            state_,
            std::make_shared<const common::OccupancyGrid>(grid_.snapshot()),
            nullptr,
            surfaces_,
            discs_,
            anybody_walks_,
            decision_,
            spare_s_,
            drift_m_,
            {},
            people_,
            seen_.points_map_m.empty() ? nullptr : &seen_,
            keep_out_,
            names_,
            map3d_,
            [this] { return unready_; },
            objects_};
  }

  common::Time now_;
  common::EventLog log_, controller_log_;
  control::FlightController controller_{{}, {}, controller_log_};
  common::VehicleState state_;
  common::OccupancyGrid grid_ = planning::test::room(160, 80);  ///< 8 m by 4 m.
  std::shared_ptr<const common::LevelMap> surfaces_;
  std::vector<common::Disc> discs_;
  std::vector<common::DynamicObstacle> people_;
  perception::SeenPoints seen_;  ///< Empty: none.
  std::shared_ptr<const std::vector<common::Polygon>> keep_out_;
  common::PlaceNames names_;
  std::shared_ptr<const common::Map3dLayer> map3d_;
  std::string unready_;                                  ///< Why the sensors cannot carry a flight.
  std::shared_ptr<const common::ObjectsLayer> objects_;  ///< Null without a recognizer.
  planning::AvoidanceDecision decision_;
  bool anybody_walks_ = false;
  double spare_s_ = 1000.0;
  double drift_m_ = 0.0;
  bool follows_ = true;           ///< The vehicle is at the reference; otherwise the test places it.
  double ceiling_m_ = kHeight_m;  ///< Where taking off ends.
  std::vector<common::Event> events_;
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  Executor executor_;

 private:
  static ExecutorConfig config(const Choices& choices) {
    ExecutorConfig config;
    config.planning.planner.kind = choices.planner;
    config.planning.explorer.kind = choices.explorer;
    return config;
  }

  /// 10 ms as the autonomy ticks: what is due is delivered, the executor at 20 Hz, then the controller.
  void step() {
    now_ += common::Duration::fromMilliseconds(10);
    state_.stamp = now_;
    jobs_->deliverDue(now_);
    if (ticks_++ % 5 == 0) executor_.tick(intent_, input());
    for (common::Event& event : log_.take()) events_.push_back(std::move(event));
    control::FlightTick tick;
    tick.now = now_;
    tick.state = state_;
    tick.battery_v = 12.4;
    (void)controller_.tick(tick);
    move();
  }

  void move() {
    const double z_m = state_.T_odom_body.position_m.z();
    double climb_m_s = 0.0;
    if (controller_.state() == FlightState::kTakingOff && z_m < ceiling_m_) climb_m_s = 0.5;
    if (controller_.state() == FlightState::kLanding && z_m > kStanding_m) climb_m_s = -0.4;
    if (controller_.state() == FlightState::kFlying && follows_) {
      const control::Reference& r = controller_.follower().reference();
      state_.T_odom_body = {common::quaternionFrom({0.0, 0.0, r.yaw_odom_rad}), r.position_odom_m};
      state_.velocity_odom_m_s = r.velocity_odom_m_s;
    } else if (controller_.state() != FlightState::kFlying) {
      state_.velocity_odom_m_s = {0.0, 0.0, climb_m_s};
      state_.T_odom_body.position_m.z() = std::max(z_m + 0.01 * climb_m_s, kStanding_m);
    }
    state_.height_above_ground_m = state_.T_odom_body.position_m.z();
  }

  long ticks_ = 0;
  common::Intent intent_;
};

class ManeuverInFlight : public ManeuverStory {
 protected:
  using ManeuverStory::ManeuverStory;
  void SetUp() override {
    ManeuverStory::SetUp();
    want(common::TakeOffIntent{kHeight_m});
    ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  }
};

}  // namespace swiftlet::autonomy
