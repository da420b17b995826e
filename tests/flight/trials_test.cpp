// The seeds of the flights of a trial.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;

class TrialSeeds : public test_support::Scratch {
 protected:
  /// The seeds of two flights of one second each.
  std::vector<int> seedsOf(const std::string& scenario, const std::vector<std::string>& options) {
    const std::string trial = write("short.yaml",
                                    "mission: missions/explore_and_return.xml\ntime_limit_s: 1\n"
                                    "scenario:\n  world: worlds/unb_case1.sdf\n" +
                                        scenario);
    std::vector<std::string> arguments = {"trial", trial, "--repeat", "2", "--json", "--out", path("out")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 1) << describe(end);  // A second is too short to explore a room.
    const auto results = nlohmann::json::parse(end.out);
    std::vector<int> seeds;
    for (const auto& flight : results.at("trials").at(0).at("flights")) seeds.push_back(flight.at("seed"));
    return seeds;
  }
};

TEST_F(TrialSeeds, StartAtTheSeedOfTheScenarioOrOfTheCommandLine) {
  EXPECT_EQ(seedsOf("", {}), (std::vector<int>{1, 2}));
  EXPECT_EQ(seedsOf("  seed: 5\n", {}), (std::vector<int>{5, 6}));
  EXPECT_EQ(seedsOf("  seed: 5\n", {"--seed", "8"}), (std::vector<int>{8, 9}));
}

}  // namespace
}  // namespace swiftlet::flight
