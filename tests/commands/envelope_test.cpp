// swiftlet trial --envelope as its users meet it, in a room that takes a moment to fly in.
#include <csignal>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/commands/missions.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::ProgramOptions;
using test_support::readText;
using test_support::runSwiftlet;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Envelope : public test_support::Scratch {
 protected:
  std::string trial() const {
    return write("hop.yaml", "mission: " + write("hop.xml", missionWith(kHop)) +
                                 "\ntime_limit_s: 20\nscenario: {world: " + write("room.sdf", worldWith(room())) +
                                 "}\n");
  }
  /// Motors that lag by 400 ms cannot be flown; scans that are a little late harm nobody.
  std::string quantities() const {
    return write("quantities.yaml",
                 "seeds: 1\nsteps: 2\nbisections: 1\nquantities:\n"
                 "  - {name: motor lag, key: quadrotor.motor_lag_s, to: 0.4}\n"
                 "  - {key: sensors.laser_link.latency_s, to: 0.01}\n");
  }
  ProgramEnd fly(std::vector<std::string> more, const ProgramOptions& options = {}) const {
    std::vector<std::string> arguments = {"trial", "--envelope", trial(), "--quantities", quantities(), "--seed", "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwiftlet(arguments, options);
  }
};

TEST_F(Envelope, FindsWhatFailsFirstAndWritesItAsTableAndPicture) {
  const std::string page = write("page.md",
                                 "# Mine\n\n<!-- written by `swiftlet trial --envelope --write` -->\nold\n"
                                 "<!-- end of what is written -->\nkept\n");
  const ProgramEnd end = fly({"--out", path("run"), "--jobs", "2", "--write", page});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto read = nlohmann::json::parse(readText(path("run/envelope.json")));
  const auto lag = read.at("quantities")[0], latency = read.at("quantities")[1];
  EXPECT_EQ(read.at("complete"), true);
  EXPECT_EQ(lag.at("base"), 0.035);
  EXPECT_GT(lag.at("fails_at"), lag.at("acceptable_to"));
  EXPECT_EQ(lag.at("steps").size(), 4u) << "the base, two steps, one bisection";
  EXPECT_EQ(latency.at("fails_at"), nullptr);
  EXPECT_EQ(latency.at("acceptable_to"), 0.01);

  const auto failed = lag.at("steps").back().at("flights")[0];
  EXPECT_TRUE(fs::exists(path("run/" + failed.at("folder").get<std::string>() + "/report.html"))) << failed;
  EXPECT_FALSE(fs::exists(path("run/base"))) << "runs that are acceptable are not kept";
  EXPECT_THAT(readText(path("run/report.html")), HasSubstr("<svg"));
  EXPECT_THAT(readText(page), testing::AllOf(HasSubstr("| motor lag |"), HasSubstr("kept"), Not(HasSubstr("old"))));
  EXPECT_TRUE(fs::exists(path("images/page.svg")));

  const ProgramEnd alone = fly({"--out", path("again"), "--json"});
  EXPECT_EQ(nlohmann::json::parse(alone.out), read) << "one job or two";
}

TEST_F(Envelope, AnInterruptionLeavesWhatIsDone) {
  ProgramOptions options;
  options.while_running = [](pid_t process, const std::string& out) {
    if (out.find("base: 1 of") != std::string::npos) kill(process, SIGINT);
  };
  const ProgramEnd end = runSwiftlet({"trial", "--envelope", "trials/papers/unb_case1.yaml", "--system", "swiftlet",
                                      "--quantities", quantities(), "--repeat", "2", "--out", path("run")},
                                     options);
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto read = nlohmann::json::parse(readText(path("run/envelope.json")));
  EXPECT_EQ(read.at("complete"), false);
  EXPECT_EQ(read.at("base_flights").at("flights").size(), 1u);
}

TEST_F(Envelope, WhatCannotBeTurnedUpIsRefusedBeforeAnyFlight) {
  const auto expectRefused = [this](const std::vector<std::string>& more, const std::string& pattern) {
    std::vector<std::string> arguments = {"--out", path("run")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramEnd end = fly(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, ContainsRegex(pattern));
    EXPECT_FALSE(fs::exists(path("run"))) << describe(end);
  };
  expectRefused({"--only", "quadrotor.motor_lag"},
                "--only: no quantity has the key `quadrotor.motor_lag`, did you mean");
  expectRefused({"--nature", "real"}, "--nature: does not go with --envelope");
  expectRefused({"--battery", "0.5"}, "--battery: does not go with --envelope");
  expectRefused({"--vehicle-memory", "m.yaml"}, "--vehicle-memory: does not go with --envelope");
  expectRefused({"--control-log"}, "--control-log: does not go with --envelope");
  expectRefused({"--record-rgbd"}, "--record-rgbd: does not go with --envelope");
  expectRefused({"--write", write("empty.md", "# Mine\n")}, "empty.md: --write: the page has no place");
  expectRefused({"--write", path("none.md")}, "none.md");

  const auto refused = [this](const std::string& trial, const std::string& quantities) {
    const ProgramEnd end =
        runSwiftlet({"trial", "--envelope", trial, "--quantities", quantities, "--out", path("run")});
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    return end.err;
  };
  EXPECT_THAT(refused(write("empty.yaml", ""), quantities()), ContainsRegex("empty.yaml:.*mission: is missing"));
  EXPECT_THAT(runSwiftlet({"trial", "--envelope", trial(), "--quantities", quantities(), "--seed", "1000000000",
                           "--repeat", "2", "--out", path("run")})
                  .err,
              HasSubstr("--seed: 2 flights from seed 1000000000 on"));
  EXPECT_THAT(refused("trials/papers", quantities()), HasSubstr("give the file of one trial"));
  EXPECT_THAT(refused("trials/papers/mit_hover.yaml", quantities()),
              HasSubstr("mit_hover.yaml: systems: names several: mit, swiftlet, give --system"));
  EXPECT_THAT(refused("trials/faults/laser.yaml", quantities()), HasSubstr("each_fault: does not go with --envelope"));
  EXPECT_THAT(refused(write("half.yaml", readText(trial()) + "batteries: [0.5]\n"), quantities()),
              HasSubstr("batteries: does not go with --envelope"));
  EXPECT_THAT(refused(trial(), write("odd.yaml", "quantities:\n  - {key: quadrotor.thrust_shere, to: 0.5}\n")),
              ContainsRegex("odd.yaml:2:11: .*did you mean `quadrotor.thrust_share`"));
  EXPECT_THAT(
      refused(trial(), write("drawn.yaml", "base: real\nquantities: [{key: quadrotor.thrust_share, to: 0.5}]\n")),
      ContainsRegex("quadrotor.thrust_share: is drawn from 0.9 to 1.1 by the base"));
}

}  // namespace
}  // namespace swiftlet::commands
