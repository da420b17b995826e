// Exploration of flat worlds by an ideal vehicle: it always ends, nothing that can be reached is left, and what is left
// has its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include <fmt/format.h>

#include "flatland.hpp"
#include "grid_builder.hpp"
#include "planning/frontiers.hpp"
#include "planning/localizability.hpp"

namespace swiftlet::planning {
namespace {

using common::FrontierReason;
using testing::HasSubstr;

void expectExplored(const test::FlightReport& report, const std::string& name) {
  EXPECT_TRUE(report.done) << name << ": " << report.last.reason;
  EXPECT_GE(report.coverage, 0.99) << name;
  EXPECT_FALSE(report.touched) << name;
  for (const common::Frontier& frontier : report.last.frontiers) {
    EXPECT_NE(frontier.reason, FrontierReason::kOpen) << name;
    EXPECT_FALSE(frontier.explanation.empty()) << name;
  }
}

void print(const test::FlightReport& r, const std::string& name) {
  std::cout << fmt::format("{:16} {:6.1f} s {:6.1f} m  coverage {:.4f}  {} calls, {} switches, {} frontiers left\n",
                           name, r.time_s, r.length_m, r.coverage, r.calls, r.switches, r.last.frontiers.size());
  if (const char* folder = std::getenv("SWIFTLET_PICTURES")) (void)folder;
}

TEST(Exploration, PocketsBehindBoxesAreSeen) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const test::Flatland world = test::pocketRoom(seed);
    const test::FlightReport report = test::fly(world, {}, seed);
    print(report, fmt::format("pocket {}", seed));
    expectExplored(report, fmt::format("pocket {}", seed));
  }
}

TEST(Exploration, RandomBuildingsAreExplored) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const test::Flatland world = test::randomBuilding(seed, 14, 10, 3, 2, 8);
    const test::FlightReport report = test::fly(world, {}, seed);
    print(report, fmt::format("building {}", seed));
    expectExplored(report, fmt::format("building {}", seed));
  }
}

}  // namespace
}  // namespace swiftlet::planning
