// What behaviours promise, by the truth.
#include "evaluation/behavior_recorder.hpp"

#include <gtest/gtest.h>

#include "evaluation/flight_score.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

class Behaviors : public testing::Test {
 protected:
  void zones(std::vector<common::Polygon> zones) {
    test::Layers layers;
    layers.map.keep_out = std::make_shared<const std::vector<common::Polygon>>(std::move(zones));
    recorder_.world(layers.world());
  }
  void at(double x_m, double y_m, bool airborne = true) {
    common::Pose3 pose;
    pose.position_m = {x_m, y_m, 1.0};
    recorder_.tick(pose, airborne);
  }
  BehaviorRecorder recorder_;
};

const common::Polygon kSquare{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};

TEST_F(Behaviors, TheLeastDistanceFromAZoneCountsFromWhenItWasOutside) {
  at(1.5, 1.5);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "there is no zone yet";
  zones({kSquare});
  at(1.5, 1.5);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "it was made around the vehicle, which leaves";
  at(0.2, 1.5, false);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "on the ground";
  at(0.0, 1.5);
  at(0.6, 1.5);
  at(0.1, 1.5);
  EXPECT_NEAR(*recorder_.record().keep_out_distance_m, 0.4, 1e-9);
  at(1.3, 1.5);
  EXPECT_NEAR(*recorder_.record().keep_out_distance_m, -0.3, 1e-9) << "inside";
}

TEST(BehaviorCriteria, AnUnmeasuredOrLesserDistanceIsAMiss) {
  FlightScore score;
  score.mission_done = true;
  Criteria criteria;
  EXPECT_TRUE(missed(score, criteria).empty());
  criteria.keep_out_gap_min_m = 0.02;
  EXPECT_EQ(missed(score, criteria).size(), 1u);
  score.behaviors.keep_out_gap_m = 0.01;
  EXPECT_EQ(missed(score, criteria).size(), 1u);
  score.behaviors.keep_out_gap_m = 0.03;
  EXPECT_TRUE(missed(score, criteria).empty());
}

}  // namespace
}  // namespace swiftlet::evaluation
