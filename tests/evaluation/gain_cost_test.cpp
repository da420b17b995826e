// What a flight costs in a search of gains.
#include <gtest/gtest.h>

#include "evaluation/gain_cost.hpp"

namespace swiftlet::evaluation {
namespace {

FlightScore hovered(double rms_m) {
  FlightScore flight;
  PhaseBound rms, time;
  rms.figure = "position_rms_m";
  rms.max = 0.1;
  time.figure = "time_s";
  time.min = 20.0;
  flight.phases = {{"hover", {{"position_rms_m", rms_m}, {"time_s", 30.0}}, {rms, time}}};
  return flight;
}

TEST(GainCost, IsTheMeanOfFigureOverBound) {
  EXPECT_DOUBLE_EQ(gainCost({hovered(0.05)}), 0.5);
  EXPECT_DOUBLE_EQ(gainCost({hovered(0.05), hovered(0.2)}), 1.25);
}

TEST(GainCost, IsBoundedForWhatWentWrong) {
  EXPECT_DOUBLE_EQ(gainCost({hovered(50.0)}), kGreatestGainCost);
  FlightScore touched = hovered(0.05);
  touched.collisions = 1;
  EXPECT_DOUBLE_EQ(gainCost({touched}), kGreatestGainCost);
  FlightScore unmeasured = hovered(0.05);
  unmeasured.phases[0].figures.clear();
  EXPECT_DOUBLE_EQ(gainCost({unmeasured}), kGreatestGainCost);
  EXPECT_DOUBLE_EQ(gainCost({FlightScore()}), kGreatestGainCost);
}

}  // namespace
}  // namespace swiftlet::evaluation
