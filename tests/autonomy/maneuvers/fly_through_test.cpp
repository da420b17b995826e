// FlyThrough: a window in a wall of 20 cm at x = 4 m, that is tracked, moves, is lost, and closes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kFreeCell;
using planning::test::kWallCell;
using testing::HasSubstr;

constexpr double kWall_m = 4.0, kHull_m = 0.275;

class FlyThroughInFlight : public ManeuverInFlight {
 protected:
  void SetUp() override {
    ManeuverInFlight::SetUp();
    build(30, 50);
    middle_ = {kWall_m, 2.0, 1.15};
  }
  /// A wall with a hole between those cells of 5 cm.
  void build(int right, int left) {
    fill(grid_, {{80, 0}, {84, 80}}, kWallCell);
    fill(grid_, {{80, right}, {84, left}}, kFreeCell);
  }
  static common::FlyThroughIntent through() {
    common::FlyThroughIntent intent;
    intent.object_id = 3;
    intent.what = "window";
    return intent;
  }
  /// Time passes, in which the window is seen, or not.
  void show(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) {
      if (seen_) last_seen_ = now_;
      common::RecognizedObject window;
      window.id = 3;
      window.what = "window";
      window.T_map_object = {common::quaternionFrom({0.0, 0.0, std::numbers::pi + turned_rad_}), middle_};
      window.covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
      window.size_m = {width_m_, 1.2};
      window.passage = passage_;
      window.confirmed = true;
      window.last_seen = last_seen_;
      objects_ = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{{window}});
      run(0.05);
      const Eigen::Vector3d at = state_.T_map_body().position_m;
      farthest_m_ = std::max(farthest_m_, at.x());
      if (std::abs(at.x() - kWall_m) < 0.5) {
        fastest_m_s_ = std::max(fastest_m_s_, state_.velocity_odom_m_s.norm());
        aside_m_ = std::max(aside_m_, std::abs(at.y() - middle_.y()));
        off_height_m_ = std::max(off_height_m_, std::abs(at.z() - middle_.z()));
      }
    }
  }
  template <typename Condition>
  void showUntil(Condition condition, double limit_s) {
    for (double s = 0.0; s < limit_s && !condition(); s += 0.05) show(0.05);
  }
  IntentState showToTheEnd(double limit_s = 60.0) {
    showUntil([this] { return ended(); }, limit_s);
    return executor_.status().state;
  }
  bool passes() const { return timesSaid("flying through window 3") > 0; }
  const std::string& reason() const { return executor_.status().reason; }

  Eigen::Vector3d middle_;
  double turned_rad_ = 0.0, width_m_ = 1.0;
  common::Passage passage_ = common::Passage::kOpen;
  bool seen_ = true;
  common::Time last_seen_;
  double farthest_m_ = 0.0;
  /// Within half a metre of the wall.
  double fastest_m_s_ = 0.0, aside_m_ = 0.0, off_height_m_ = 0.0;
};

TEST_F(FlyThroughInFlight, PassesTheMiddleSlowlyAtItsHeight) {
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kSucceeded) << reason();
  EXPECT_THAT(reason(), HasSubstr("behind window 3"));
  EXPECT_NEAR(position_m().x(), kWall_m + 1.2, 0.13);
  EXPECT_LT(aside_m_, 0.02);
  EXPECT_LT(off_height_m_, 0.02);
  EXPECT_LT(fastest_m_s_, 0.41);
  EXPECT_GT(fastest_m_s_, 0.2);
}

TEST_F(FlyThroughInFlight, FollowsTheMiddleThatIsTracked) {
  build(24, 56);
  want(through());
  showUntil([this] { return passes(); }, 30.0);
  ASSERT_LT(position_m().x(), kWall_m - 1.2);
  middle_.y() = 2.15;
  turned_rad_ = 0.05;
  EXPECT_EQ(showToTheEnd(), IntentState::kSucceeded) << reason();
  EXPECT_LT(aside_m_, 0.04);
  EXPECT_NEAR(state_.T_map_body_planar().yaw_rad, 0.05, 0.03);
}

TEST_F(FlyThroughInFlight, TurnsBackWhenItIsLostBeforeTheHullIsInIt) {
  want(through());
  showUntil([this] { return passes(); }, 30.0);
  seen_ = false;
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "it is no longer seen");
  EXPECT_LT(farthest_m_, kWall_m - kHull_m);
  EXPECT_NEAR(position_m().x(), kWall_m - 1.6, 0.2) << "before it again";
  EXPECT_EQ(timesSaid("turning back before window 3"), 1);
}

TEST_F(FlyThroughInFlight, GoesOnWhenItIsLostWithTheHullInIt) {
  want(through());
  showUntil([this] { return position_m().x() > kWall_m - kHull_m; }, 60.0);
  seen_ = false;
  EXPECT_EQ(showToTheEnd(), IntentState::kSucceeded) << reason();
}

TEST_F(FlyThroughInFlight, TurnsBackBeforeAShutterThatCloses) {
  want(through());
  showUntil([this] { return passes(); }, 30.0);
  passage_ = common::Passage::kClosed;
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "it is closed");
  EXPECT_LT(farthest_m_, kWall_m - kHull_m);
}

/// The reactive layer brakes for what only the laser sees.
TEST_F(FlyThroughInFlight, TurnsBackBeforeWhatStaysInTheWay) {
  want(through());
  showUntil([this] { return position_m().x() > kWall_m - 1.0; }, 60.0);
  ASSERT_TRUE(passes());
  decision_.speed_limit_m_s = 0.0;
  executor_.react(decision_, state_);
  show(3.0);
  EXPECT_EQ(timesSaid("turning back"), 0) << "it may go";
  show(5.0);
  EXPECT_EQ(timesSaid("turning back"), 1);
  calm();
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "something is in the way");
}

TEST_F(FlyThroughInFlight, DoesNotBeginWithoutRoomOrSight) {
  width_m_ = 0.7;
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_THAT(reason(), HasSubstr("too narrow for the hull"));
  width_m_ = 1.0;
  passage_ = common::Passage::kClosed;
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "it is closed");
  passage_ = common::Passage::kOpen;
  seen_ = false;
  show(3.0);
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "it is not seen from before it");
  EXPECT_LT(farthest_m_, kWall_m - 1.4);
}

TEST_F(FlyThroughInFlight, DoesNotBeginThroughAKeepOutZoneOrIntoAWall) {
  keep_out_ = std::make_shared<const std::vector<common::Polygon>>(
      std::vector<common::Polygon>{{{{4.35, 1.9}, {4.45, 1.9}, {4.45, 2.1}, {4.35, 2.1}}}});
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "a keep-out zone is in the way");
  keep_out_ = nullptr;
  fill(grid_, {{90, 0}, {92, 80}}, kWallCell);
  want(through());
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "no place behind it is known to be free");
}

TEST_F(FlyThroughInFlight, GoesOnInTheDirectionInWhichItWasInterruptedInTheWindow) {
  want(through());
  showUntil([this] { return position_m().x() > kWall_m + 0.2; }, 60.0);
  want(common::HoldIntent{});
  show(2.0);
  seen_ = false;
  wantAgain(through(), 2);
  EXPECT_EQ(showToTheEnd(), IntentState::kSucceeded) << reason();
  EXPECT_GT(position_m().x(), kWall_m + 1.0);
}

TEST_F(FlyThroughInFlight, AnObjectThatIsNotKnownIsAReason) {
  common::FlyThroughIntent intent = through();
  intent.object_id = 9;
  want(intent);
  EXPECT_EQ(showToTheEnd(), IntentState::kFailed);
  EXPECT_EQ(reason(), "no window 9 is known");
}

}  // namespace
}  // namespace swiftlet::autonomy
