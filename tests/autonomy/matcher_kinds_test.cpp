// The matcher that the profile names holds the estimate of a flight.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "common/config.hpp"
#include "tests/autonomy/estimator_story.hpp"

namespace swiftlet::autonomy {
namespace {

struct Flown {
  int scans = 0, matched = 0;
  double worst_m = 0.0;
  perception::LaserOdometryCounts counts;
};

Flown fly(const std::string& kind) {
  EstimatorConfig config = EstimatorStory::config();
  common::config::YamlReader::fromText("odometry: {matcher: {kind: " + kind + "}}", kind).read(config);
  EstimatorStory story(12.0, nullptr, config);
  Flown flown;
  story.run(11.5, [&](const std::optional<ScanOutcome>& outcome) {
    if (!outcome) return;
    ++flown.scans;
    flown.matched += outcome->matched ? 1 : 0;
    flown.worst_m = std::max(flown.worst_m, story.positionError_m());
  });
  flown.counts = story.estimator.counts().odometry;
  std::printf("  %-13s %d of %d scans matched, worst %.3f m, restarts %d\n", kind.c_str(), flown.matched, flown.scans,
              flown.worst_m, static_cast<int>(flown.counts.restarts));
  return flown;
}

void expectHeld(const Flown& flown) {
  EXPECT_GT(flown.matched, flown.scans * 95 / 100);
  EXPECT_LT(flown.worst_m, 0.1);
  EXPECT_EQ(flown.counts.restarts, 0u);
}

TEST(MatcherOfTheProfile, CorrelativeHoldsTheEstimate) {
  const Flown flown = fly("correlative");
  expectHeld(flown);
  EXPECT_GE(flown.counts.correlative_searches, static_cast<std::uint64_t>(flown.matched - 1));
  EXPECT_EQ(flown.counts.gauss_newton_searches + flown.counts.point_to_line_searches, 0u);
}

TEST(MatcherOfTheProfile, GaussNewtonHoldsTheEstimate) {
  const Flown flown = fly("gauss_newton");
  expectHeld(flown);
  EXPECT_GE(flown.counts.gauss_newton_searches, static_cast<std::uint64_t>(flown.matched - 1));
  EXPECT_EQ(flown.counts.correlative_searches + flown.counts.point_to_line_searches, 0u);
}

TEST(MatcherOfTheProfile, PointToLineHoldsTheEstimate) {
  const Flown flown = fly("point_to_line");
  expectHeld(flown);
  EXPECT_GE(flown.counts.point_to_line_searches, static_cast<std::uint64_t>(flown.matched - 1));
  EXPECT_EQ(flown.counts.correlative_searches + flown.counts.gauss_newton_searches, 0u);
}

}  // namespace
}  // namespace swiftlet::autonomy
