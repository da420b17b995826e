// The height that the filter is given as a prior has not heard of the last measurements: they are published late.
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "common/square.hpp"
#include "perception/altitude/multilevel_filter.hpp"

namespace swiftlet::perception {
namespace {

// A prior whose speed errs by 3 cm/s has, when the measurements are 0.15 s late, an error of half a centimetre that
// does not change for a second or two. That is no slope.
TEST(MultilevelFilter, AnErrorOfThePriorThatStaysIsNoSlope) {
  MultilevelFilter filter{MultilevelFilter::Config{}};
  common::RandomStream random(1, "prior");
  filter.initialize(common::Time::fromSeconds(0.0), {0, 0}, 1.0);
  int measured = 0, scans = 0;
  for (double now_s = 0.025; now_s < 3.0; now_s += 0.025, ++scans) {
    std::vector<GroundPoint> points;
    for (int i = 0; i < 10; ++i) points.push_back({{0.0, 0.0}, 1.0 + random.gaussian(0.01)});
    HeightState prior{common::Time::fromSeconds(now_s), 1.0045, 0.03};
    prior.covariance << common::square(0.006), 0.0, 0.0, common::square(0.03);
    measured += filter.update(prior, {0, 0}, points).measurement ? 1 : 0;
  }
  EXPECT_GE(measured, scans - 10);
}

}  // namespace
}  // namespace swiftlet::perception
