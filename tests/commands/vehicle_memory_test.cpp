// --vehicle-memory: what a flight learns of its vehicle is a file for the next one; trials read it and never write it.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/commands/missions.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

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

constexpr const char* kMemory =
    "version: 1\n"
    "vehicle: cobra\n"
    "thrust:\n"
    "  - {voltage_v: 10.0, hover_command: 0.95, seen_s: 10}\n"
    "  - {voltage_v: 12.5, hover_command: 0.66, seen_s: 20}\n";

class VehicleMemoryFile : public RefusalsBeforeWriting {
 protected:
  ProgramEnd hop(const std::string& memory, const std::string& run) const {
    return runSwiftlet({"fly", write("hop.xml", missionWith(kHop)), "--headless", "--nature", "real", "--seed", "4",
                        "--vehicle-memory", memory, "--out", path(run)});
  }
};

TEST_F(VehicleMemoryFile, IsMadeByTheFirstFlightAndGoesOnWithTheNext) {
  const std::string memory = path("cobra.yaml");
  ASSERT_EQ(hop(memory, "first").exit_code, 0);
  const std::string first = readText(memory);
  EXPECT_THAT(first, HasSubstr("version: 1\nvehicle: \"cobra\"\nthrust:\n"));
  EXPECT_FALSE(fs::exists(path("first/vehicle_memory_read.yaml"))) << "there was nothing to read";
  EXPECT_EQ(readText(path("first/vehicle_memory_learned.yaml")), first);

  const ProgramEnd second = hop(memory, "second");
  ASSERT_EQ(second.exit_code, 0) << describe(second);
  EXPECT_THAT(second.out, HasSubstr("memory: starts from what earlier flights learned"));
  EXPECT_EQ(readText(path("second/vehicle_memory_read.yaml")), first);
  EXPECT_EQ(readText(path("second/vehicle_memory_learned.yaml")), readText(memory));
  EXPECT_NE(readText(memory), first);
}

TEST_F(VehicleMemoryFile, WithoutItNothingIsRemembered) {
  ASSERT_EQ(runSwiftlet({"fly", write("hop.xml", missionWith(kHop)), "--headless", "--out", path("run")}).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(path("run")))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("memory")));
}

TEST_F(VehicleMemoryFile, AWrongOneIsRefusedWithItsPlace) {
  const auto refused = [&](const std::string& text, const std::string& pattern) {
    expectRefused(hop(write("memory.yaml", text), "run"), pattern);
  };
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kMemory;
    return text.replace(text.find(from), from.size(), to);
  };
  refused(with("version: 1", "version: 2"), "memory\\.yaml:1:[0-9]+: version");
  refused(with("version: 1\n", ""), "memory\\.yaml.*version");
  refused(with("cobra", "pelican"), "memory\\.yaml:2:[0-9]+: vehicle: is that of `pelican`, but `cobra` flies");
  refused(with("voltage_v: 12.5", "voltage_v: 16.5"),
          "memory\\.yaml:5:[0-9]+: thrust\\[1\\]\\.voltage_v: 16\\.5 V is of another battery: that of `cobra` has "
          "9\\.18 to "
          "12\\.60 V in flight, give each battery a file of its own");
  refused(with("voltage_v: 10.0", "voltage_v: 7.4"), "memory\\.yaml:4:[0-9]+: .*7\\.4 V is of another battery");
  refused(with("hover_command: 0.95", "hover_command: 95"), "memory\\.yaml:4:[0-9]+: .*hover_command");
  refused(with("hover_command: 0.66", "hover_command: 0.96"), "memory\\.yaml.*must not rise with the voltage");
  refused(with("voltage_v: 12.5", "voltage: 12.5"), "memory\\.yaml:5:[0-9]+: .*did you mean `voltage_v`");
  refused("{", "memory\\.yaml:");
  expectRefused(hop(path("nowhere/memory.yaml"), "run"), "nowhere/memory\\.yaml: --vehicle-memory: its folder");
}

TEST_F(VehicleMemoryFile, OneThatCannotBeWrittenIsToldBeforeTheFlight) {
  expectRefused(hop("/proc/memory.yaml", "run"), "--vehicle-memory: cannot be written: /proc/memory\\.yaml: ");
}

TEST_F(VehicleMemoryFile, WhatWasLearnedIsInTheRunIfItCannotBeWrittenAnyMore) {
  fs::create_directories(path("gone"));
  ProgramOptions options;
  options.while_running = [&](pid_t, const std::string& out) {
    if (out.find("take") != std::string::npos) fs::remove_all(path("gone"));
  };
  const ProgramEnd end = runSwiftlet({"fly", write("hop.xml", missionWith(kHop)), "--headless", "--speed", "4",
                                      "--vehicle-memory", path("gone/cobra.yaml"), "--out", path("run")},
                                     options);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, ContainsRegex("--vehicle-memory: cannot be written: .*gone/cobra\\.yaml: No such file or "
                                     "directory; what was learned is in .*run/vehicle_memory_learned\\.yaml"));
  EXPECT_THAT(readText(path("run/vehicle_memory_learned.yaml")), HasSubstr("thrust:"));
}

TEST_F(VehicleMemoryFile, IsOfOneVehicle) {
  expectRefused(
      runSwiftlet({"fly", "missions/explore_and_return.xml", "--headless", "--scenario", "trials/two_vehicles.yaml",
                   "--vehicle-memory", write("memory.yaml", kMemory), "--out", path("run")}),
      "is of one vehicle, but 2 fly");
}

TEST_F(VehicleMemoryFile, EveryFlightOfATrialStartsFromItAndNoneWritesIt) {
  const std::string memory = write("memory.yaml", kMemory), mission = write("hop.xml", missionWith(kHop));
  const std::string trial =
      write("hops.yaml", "mission: " + mission + "\nrepeat: 2\nscenario: {world: worlds/unb_case1.sdf}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--vehicle-memory", memory, "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(readText(memory), kMemory);
  const std::string read = readText(path("out/hops-001/vehicle_memory_read.yaml"));
  EXPECT_THAT(read, HasSubstr("hover_command: 0.66"));
  EXPECT_EQ(readText(path("out/hops-002/vehicle_memory_read.yaml")), read);
  EXPECT_TRUE(fs::exists(path("out/hops-002/vehicle_memory_learned.yaml")));
  expectRefused(runSwiftlet({"trial", trial, "--vehicle-memory", path("none.yaml"), "--out", path("run")}),
                "none\\.yaml: --vehicle-memory: no such file");
}

}  // namespace
}  // namespace swiftlet::commands
