// Loops past markers, with estimates whose errors are known.
#include "evaluation/marker_errors.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace swiftlet::evaluation {
namespace {

using common::Pose2;
using common::Time;

/// A goal that was reached: the true pose, the map's estimate and that of the odometry.
ReachedGoal reached(double time_s, const Eigen::Vector2d& goal_map_m, const Pose2& truth, const Pose2& estimate,
                    const Pose2& odometry) {
  ReachedGoal goal;
  goal.stamp = Time::fromSeconds(time_s);
  goal.goal_map_m = goal_map_m;
  goal.estimate = {estimate, odometry, truth};
  return goal;
}

TEST(MarkerErrors, AreNotMeasuredWithoutGoals) {
  const auto visits = markerVisits({});
  EXPECT_FALSE(markerError_m(visits) || relocalizationError_m(visits) || openLoopError_m(visits));
}

TEST(MarkerErrors, CompareTheEstimateWithTheTruthAndNotWithTheGoal) {
  // 4 cm off the marker, with an estimate right within 5 mm.
  const auto visits = markerVisits({reached(9, {3, 0}, {2.96, 0, 0}, {2.963, 0.004, 0}, {2.963, 0.004, 0})});
  ASSERT_EQ(visits.size(), 1u);
  EXPECT_EQ(visits[0].stamp, Time::fromSeconds(9));
  EXPECT_NEAR(*markerError_m(visits), 0.005, 1e-12);
  EXPECT_FALSE(relocalizationError_m(visits)) << "seen once";
  EXPECT_FALSE(openLoopError_m(visits)) << "no loop was flown";
}

TEST(MarkerErrors, RelocalizationComparesTheErrorsOfSeveralVisitsOfAMarker) {
  const auto visits = markerVisits({reached(10, {3, 0}, {3.00, 0.00, 0}, {3.010, 0.00, 0}, {}),
                                    reached(20, {0, 4}, {0.00, 4.00, 0}, {-0.02, 4.00, 0}, {}),
                                    reached(30, {3, 0}, {2.96, 0.03, 0}, {2.968, 0.03, 0}, {}),
                                    reached(40, {3, 0}, {3.02, 0.00, 0}, {3.017, 0.00, 0}, {})});
  EXPECT_NEAR(*relocalizationError_m(visits), 0.013, 1e-12) << "+10 mm in the first loop, -3 mm in the last";
  EXPECT_NEAR(*markerError_m(visits), 0.020, 1e-12);
}

TEST(MarkerErrors, GoalsAFewMillimetresApartAreTheSameMarker) {
  const auto visits =
      markerVisits({reached(10, {0, 0}, {}, {0.002, 0, 0}, {}), reached(20, {0.004, 0.003}, {}, {0, 0.001, 0}, {})});
  EXPECT_NEAR(*relocalizationError_m(visits), std::hypot(0.002, 0.001), 1e-12);
}

TEST(MarkerErrors, TheFirstLoopBeginsAtTakeOff) {
  const auto visits = markerVisits({reached(60, {0, 0}, {0.01, 0.02, 0}, {}, {0.31, -0.08, 0.1})});
  ASSERT_TRUE(visits[0].open_loop_error_m);
  EXPECT_NEAR(visits[0].open_loop_error_m->x(), 0.3, 1e-12);
  EXPECT_NEAR(visits[0].open_loop_error_m->y(), -0.1, 1e-12);
}

// The odometry drifted and turned in the first loop. The second loop is judged only by the drift it adds.
TEST(MarkerErrors, TheOpenLoopErrorOfEachLoopStartsAtZero) {
  const Pose2 drift{0.4, -0.2, 0.05}, truth_1{0.02, 0.01, -1.2}, truth_2{-0.03, 0.02, -1.1};
  const Pose2 added{truth_2.x_m + 0.07, truth_2.y_m - 0.02, truth_2.yaw_rad};
  const auto visits = markerVisits(
      {reached(60, {0, 0}, truth_1, truth_1, drift * truth_1), reached(120, {0, 0}, truth_2, truth_2, drift * added)});
  ASSERT_TRUE(visits[1].open_loop_error_m);
  EXPECT_NEAR(visits[1].open_loop_error_m->x(), 0.07, 1e-12);
  EXPECT_NEAR(visits[1].open_loop_error_m->y(), -0.02, 1e-12);
  EXPECT_GT(*openLoopError_m(visits), 0.4) << "of the first, the worse one";
  EXPECT_NEAR(*markerError_m(visits), 0.0, 1e-12) << "the map had put it right";
}

}  // namespace
}  // namespace swiftlet::evaluation
