// Data sheets of the user: where a profile finds them, and that what is made of them can be used without the profile.
#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
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
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class ProfileSheets : public Refusals {};

/// The base and what it names lie in one folder, the profile that is based on it in another.
TEST_F(ProfileSheets, DataSheetsAreFoundBesideTheProfileThatNamesThemNotTheOneBasedOnIt) {
  for (const char* folder : {"lib", "child"}) fs::create_directory(path(folder));
  (void)write("lib/base.yaml", "vehicle: nimble.yaml\n");
  (void)write("lib/nimble.yaml", "name: nimble\nmass_kg: 1.2\n");
  (void)write("child/nimble.yaml", "name: nimble\nmass_kg: 9.9\n");
  const std::string child = write("child/child.yaml", "based_on: ../lib/base.yaml\nlaser: utm_30lx\n");
  const ProgramEnd found = runSwiftlet({"config", "--system", child});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("mass_kg: 1.2"));
  fs::remove(path("lib/nimble.yaml"));
  expectRefused(runSwiftlet({"config", "--system", child}), "base\\.yaml:1:10: vehicle: nimble\\.yaml: no such file");
  (void)write("lib/base.yaml", "autonomy:\n  control:\n    controller: {kind: lqr}\n");
  expectRefused(runSwiftlet({"config", "--system", child}),
                "base\\.yaml:3:24: autonomy\\.control\\.controller\\.kind: lqr needs a vehicle_model");
}

TEST_F(ProfileSheets, FormerSettingsAreRefusedWithWhatTheyAreNow) {
  const std::string one = write("one.yaml", "based_on: swiftlet\nautonomy: {estimator: {altitude: {gate_sigma: 4}}}\n");
  expectRefused(
      runSwiftlet({"config", "--system", one}),
      "one\\.yaml:2:35: autonomy\\.estimator\\.altitude: `gate_sigma` is no longer a setting: it is 3\\.5: Half "
      "width of all confidence regions, in standard deviations\\., leave it out");
  const std::string all = write("all.yaml", "based_on: swiftlet\nautonomy:\n  inertial_check: {rate_deg_s: 30}\n");
  expectRefused(
      runSwiftlet({"config", "--system", all}),
      "all\\.yaml:3:3: autonomy: `inertial_check` is no longer a section: what it set is fixed, leave it out");
}

/// The paths of what a YAML with two blanks a level sets: "autonomy.scans.latency_s".
std::set<std::string> pathsOf(const std::string& yaml) {
  std::set<std::string> paths;
  std::vector<std::string> above;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' '), colon = line.find(':');
    if (begin == std::string::npos || colon == std::string::npos) continue;
    above.resize(begin / 2);
    above.push_back(line.substr(begin, colon - begin));
    if (colon + 1 < line.size()) paths.insert(fmt::format("{}", fmt::join(above, ".")));
  }
  return paths;
}

TEST_F(ProfileSheets, NoFormerSettingIsOneAgain) {
  const std::set<std::string> settings = pathsOf(runSwiftlet({"config", "--plain"}).out);
  EXPECT_TRUE(settings.contains("autonomy.scans.latency_s"));
  EXPECT_LE(settings.size(), 150u);
  int former = 0;
  std::istringstream lines(readText(SWIFTLET_SOURCE_DIR "/config/former_settings.yaml"));
  for (std::string line; std::getline(lines, line); ++former)
    EXPECT_FALSE(settings.contains(line.substr(0, line.find(':')))) << line;
  EXPECT_GT(former, 500);
}

/// The sheet and the folder of the profile are gone; the run has all that it needs.
TEST_F(ProfileSheets, ARunKeepsTheSheetsThatAreNotShipped) {
  write("nimble.yaml", "name: nimble\nmass_kg: 1.4\nbattery_capacity_ah: 3\n");
  const std::string mine = write("mine.yaml", "vehicle: nimble.yaml\nlaser: utm_30lx\n");
  const ProgramEnd flight = runSwiftlet({"fly", write("hop.xml", missionWith(kHop)), "--headless", "--system", mine,
                                         "--control-log", "--out", path("run")});
  ASSERT_EQ(flight.exit_code, 0) << describe(flight);
  fs::remove(path("mine.yaml"));
  fs::rename(path("nimble.yaml"), path("moved.yaml"));
  fs::rename(path("run"), path("other"));
  const std::string kept = path("other/vehicle.yaml");
  EXPECT_THAT(readText(path("other/config.yaml")), HasSubstr("vehicle: \"vehicle.yaml\""));
  EXPECT_FALSE(fs::exists(path("other/laser.yaml"))) << "it is shipped";
  const ProgramEnd end = runSwiftlet({"identify", path("other"), "--vehicle", path("moved.yaml")});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("not identified: forward: "));
  expectRefused(runSwiftlet({"identify", path("other")}), "`nimble` flew, not `cobra`, give --vehicle .*/vehicle.yaml");
  expectRefused(runSwiftlet({"consistency", path("other")}), "give a --system whose vehicle is .*/vehicle.yaml");
  const std::string other = write("moved.yaml", "name: nimble\nmass_kg: 1.5\nbattery_capacity_ah: 3\n");
  expectRefused(runSwiftlet({"identify", path("other"), "--vehicle", other}),
                "another `nimble` flew: its mass_kg is 1.4, not 1.5, give --vehicle .*/vehicle.yaml");
  const ProgramEnd again = runSwiftlet(
      {"fly", path("hop.xml"), "--headless", "--system", path("other/config.yaml"), "--out", path("again")});
  EXPECT_EQ(again.exit_code, 0) << describe(again);
  EXPECT_EQ(readText(path("again/vehicle.yaml")), readText(kept));
  EXPECT_EQ(readText(path("again/config.yaml")), readText(path("other/config.yaml")));
}

TEST_F(ProfileSheets, GainsOfAProfileWithSheetsBesideItAreTunedAndKeptWhenStopped) {
  write("nimble.yaml", "name: nimble\nmass_kg: 1.4\n");
  const std::string mine = write("mine.yaml", "based_on: unb\nvehicle: nimble.yaml\n");
  fs::create_directory(path("out"));
  const std::string found = path("out/found.yaml");
  test_support::ProgramOptions options;
  options.working_folder = path("out");
  bool sent = false;
  options.while_running = [&](pid_t process, const std::string& out) {
    if (!sent && out.find("set   1") != std::string::npos) kill(process, SIGINT);
    sent = sent || out.find("set   1") != std::string::npos;
  };
  const ProgramEnd end = runSwiftlet({"tune", "--gains", "trials/papers/gains.yaml", "--system", mine, "--seeds", "1",
                                      "--flights", "40", "--out", found},
                                     options);
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("stopped before the search was over"));
  EXPECT_THAT(end.out, HasSubstr("profile " + found));
  EXPECT_TRUE(readText(found).starts_with("# Tuned by `swiftlet tune --gains`"));
  const ProgramEnd read = runSwiftlet({"config", "--system", found});
  EXPECT_EQ(read.exit_code, 0) << describe(read);
  EXPECT_THAT(read.out, HasSubstr("mass_kg: 1.4"));
  std::string first_set;
  for (const auto& entry : fs::recursive_directory_iterator(path("out/runs")))
    if (entry.path().filename() == "set-001.yaml") first_set = readText(entry.path());
  EXPECT_TRUE(first_set.starts_with("# cost ")) << first_set.substr(0, 40);
}

}  // namespace
}  // namespace swiftlet::commands
