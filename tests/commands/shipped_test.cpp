// Everything that comes with the software can be used: missions, worlds, trials, profiles and data sheets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "common/config.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "evaluation/trial.hpp"
#include "simulation/world_model.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using common::config::readFile;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kRoot = SWIFTLET_SOURCE_DIR;

/// Paths, from the root, of the shipped files below `folder` that end so; at least `least` of them.
std::vector<std::string> shipped(const std::string& folder, const std::string& ending, std::size_t least) {
  std::vector<std::string> files;
  if (fs::exists(kRoot / folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.path().extension() == ending) files.push_back(fs::relative(entry.path(), kRoot).string());
  }
  std::sort(files.begin(), files.end());
  EXPECT_GE(files.size(), least) << "in " << folder;
  return files;
}

/// It has a behaviour that `check` refuses with a profile without a camera.
bool needsCamera(const std::string& mission) {
  std::ifstream file(kRoot / mission);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto has = [&](const char* leaf) { return text.find(leaf) != std::string::npos; };
  return has("<Photograph") || has("<Inspect") || has("<LookAround") || has("<ExploreUntilFound") ||
         has("leave_house_by_window");
}

TEST(Shipped, EachMissionIsValidAndFoundFromAnyFolder) {
  test_support::ProgramOptions elsewhere;
  elsewhere.working_folder = "/";
  std::vector<std::string> missions = shipped("missions", ".xml", 2);
  for (std::string& mission : shipped("trials/missions", ".xml", 1)) missions.push_back(std::move(mission));
  for (const std::string& mission : missions) {
    // The editor's palette; and tasks, which get their places from the missions that include them.
    if (mission.starts_with("missions/groot2/") || mission.starts_with("missions/tasks/")) continue;
    std::vector<std::string> arguments{"check", mission};
    if (needsCamera(mission)) arguments.insert(arguments.end(), {"--system", "swiftlet_3d"});
    const ProgramEnd end = runSwiftlet(arguments, elsewhere);
    EXPECT_EQ(end.exit_code, 0) << mission << ": " << describe(end);
  }
}

TEST(Shipped, EachWorldLoads) {
  for (const std::string& world : shipped("worlds", ".sdf", 1))
    EXPECT_FALSE(simulation::loadWorld((kRoot / world).string(), {}).shapes.empty()) << world;
}

TEST(Shipped, EachTrialLoadsAndNamesExistingFiles) {
  for (const std::string& file : shipped("trials", ".yaml", 1)) {
    const evaluation::TrialConfig trial = evaluation::readTrial(kRoot / file);
    EXPECT_TRUE(fs::exists(kRoot / trial.mission)) << file << ": " << trial.mission;
    for (const evaluation::TrialConfig& one : trial.byCondition())
      EXPECT_TRUE(fs::exists(kRoot / "config/systems" / (one.system + ".yaml"))) << file << ": " << one.system;
    if (trial.archive.empty() && trial.scenario.model_paths.empty()) {
      EXPECT_FALSE(simulation::loadWorld((kRoot / trial.scenario.world).string(), {}).shapes.empty())
          << file << ": " << trial.scenario.world;
    }
  }
}

TEST(Shipped, EachDataSheetLoads) {
  for (const std::string& file : shipped("config/vehicles", ".yaml", 1))
    EXPECT_NO_THROW(readFile<common::VehicleConfig>((kRoot / file).string())) << file;
  for (const std::string& file : shipped("config/sensors", ".yaml", 1))
    if (test_support::readText(kRoot / file).find("\nbeams:") != std::string::npos)
      EXPECT_NO_THROW(readFile<common::LaserConfig>((kRoot / file).string())) << file;
    else
      EXPECT_NO_THROW(readFile<common::RgbdCameraConfig>((kRoot / file).string())) << file;
}

TEST(Shipped, TheReferenceOfAllSettingsIsUpToDate) {
  EXPECT_EQ(test_support::readText(kRoot / "docs/configuration.md"), runSwiftlet({"config", "--reference"}).out)
      << "update it: swiftlet config --reference > docs/configuration.md";
}

TEST(Shipped, TheTableOfFailSafesIsUpToDate) {
  EXPECT_EQ(test_support::readText(kRoot / "docs/failsafes.md"), runSwiftlet({"failsafe", "--markdown"}).out)
      << "update it: swiftlet failsafe --markdown > docs/failsafes.md";
  EXPECT_EQ(test_support::readText(kRoot / "web/console/failsafes.json"), runSwiftlet({"failsafe", "--json"}).out)
      << "update it: swiftlet failsafe --json > web/console/failsafes.json";
}

TEST(Failsafe, TellsWhichOfSeveralFindingsIsActive) {
  const ProgramEnd told = runSwiftlet({"failsafe", "--phase", "flying", "charge-for-home", "surroundings-unseen"});
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_THAT(told.out, testing::StartsWith("flying: hold\n  because of: surroundings unseen\n"));
  EXPECT_THAT(told.out, testing::HasSubstr("charge for home alone: fly home, then land\n"));
  const ProgramEnd mistyped = runSwiftlet({"failsafe", "thrust-spend"});
  EXPECT_EQ(mistyped.exit_code, 2);
  EXPECT_THAT(mistyped.err, testing::HasSubstr("thrust-spent"));
}

/// The sentences of a reference page that cannot be read without the line before, with their setting or section.
std::vector<std::string> dependentSentences(const std::string& page) {
  static const std::regex kStandsAlone(
      "(?!(Or|And|The same|That|Those|It|Its|Their|They|Of that|Of these|There|Then)\\b)[^a-z].*\\.");
  std::vector<std::string> dependent;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    std::string named = line, sentence;
    if (line.starts_with("##")) {  // A section's sentence is in the paragraph below its heading.
      std::getline(lines, sentence);
      std::getline(lines, sentence);
    } else if (line.starts_with("| `")) {
      named = line.substr(2, line.find('`', 3) - 1);
      sentence = line.substr(line.rfind(" | ") + 3);
      sentence.erase(sentence.rfind(" |"));
    } else {
      continue;
    }
    if (!std::regex_match(sentence, kStandsAlone)) dependent.push_back(named + ": " + sentence);
  }
  return dependent;
}

TEST(Shipped, EachSentenceOfASettingStandsAlone) {
  EXPECT_THAT(dependentSentences(runSwiftlet({"config", "--reference"}).out), IsEmpty());
}

TEST(Shipped, APlantedSentenceThatRunsOnIsCaught) {
  EXPECT_THAT(dependentSentences("## `laser`\n\nThe laser.\n\n| `rate_hz` | `40` | 1 to 100 | Sweeps a second. |\n"
                                 "| `others` | `1` | | Other lasers. |\n| `item` | `1` | | Items. |\n"),
              IsEmpty());
  EXPECT_THAT(
      dependentSentences("### `laser`\n\nIts mount.\n\n| `a_m` | `1` | | The same of the mount. |\n"
                         "| `b_m` | `1` | | and by this. |\n| `c_m` | `1` | |  |\n| `d_m` | `1` | | A side |\n"),
      ElementsAre("### `laser`: Its mount.", "`a_m`: The same of the mount.", "`b_m`: and by this.",
                  "`c_m`: ", "`d_m`: A side"));
}

/// A mission that asks for targets of any of these colours can be flown with any profile that has a colour camera.
TEST(Shipped, EachProfileWithAColourCameraNamesTheSameColours) {
  int with_camera = 0;
  for (const std::string& file : shipped("config/systems", ".yaml", 1)) {
    const std::string name = fs::path(file).stem().string();
    const std::string printed = runSwiftlet({"config", "--system", name}).out;
    if (printed.find("\nrgbd_camera: \"\"") != std::string::npos) continue;
    if (printed.find("firefly_stereo") != std::string::npos) continue;  // Targets need the depth that a pair has not.
    ++with_camera;
    for (const std::string colour : {"red", "yellow", "green", "blue"})
      EXPECT_NE(printed.find("name: \"" + colour + "\""), std::string::npos) << name << ": " << colour;
    for (const std::string mission : {"missions/find_target.xml", "missions/search_and_report.xml"}) {
      const ProgramEnd end = runSwiftlet({"check", mission, "--system", name});
      EXPECT_EQ(end.exit_code, 0) << name << ": " << describe(end);
    }
  }
  EXPECT_GE(with_camera, 4);
}

class Profiles : public test_support::Scratch {};

// "swiftlet config > mine.yaml" is where one's own profile begins.
TEST_F(Profiles, EachLoadsAndReadsBackAsPrinted) {
  for (const std::string& file : shipped("config/systems", ".yaml", 1)) {
    const std::string name = fs::path(file).stem().string();
    const ProgramEnd printed = runSwiftlet({"config", "--system", name});
    ASSERT_EQ(printed.exit_code, 0) << name << ": " << describe(printed);
    const ProgramEnd again = runSwiftlet({"config", "--system", write(name + ".yaml", printed.out)});
    EXPECT_EQ(again.exit_code, 0) << name << ": " << describe(again);
    EXPECT_EQ(again.out, printed.out) << name;
  }
}

TEST_F(Profiles, AProfileDiffersFromTheOneItIsBasedOnInWhatItNames) {
  const std::string text = "based_on: swiftlet_3d_20ah\nautonomy: {control: {position: {max_speed_m_s: 0.5}}}\n";
  const ProgramEnd mine = runSwiftlet({"config", "--plain", "--system", write("mine.yaml", text)});
  ASSERT_EQ(mine.exit_code, 0) << describe(mine);
  std::string expected = runSwiftlet({"config", "--plain", "--system", "swiftlet_3d_20ah"}).out;
  const std::string before = "      max_speed_m_s: 0.75\n";
  const std::size_t place = expected.find(before);
  ASSERT_NE(place, std::string::npos);
  expected.replace(place, before.size(), "      max_speed_m_s: 0.5\n");
  EXPECT_EQ(mine.out, expected);
}

TEST_F(Profiles, AreNotBasedOnThemselvesOrOnWhatDoesNotExist) {
  write("a.yaml", "based_on: b.yaml\n");
  const std::string b = write("b.yaml", "laser: urg_04lx\nbased_on: a.yaml\n");
  const ProgramEnd circle = runSwiftlet({"config", "--system", b});
  EXPECT_EQ(circle.exit_code, 2) << describe(circle);
  EXPECT_THAT(circle.err, testing::HasSubstr("a.yaml:1:11: based_on: b.yaml is based on this profile itself"));
  const ProgramEnd itself = runSwiftlet({"config", "--system", write("d.yaml", "based_on: ./d.yaml\n")});
  EXPECT_EQ(itself.exit_code, 2) << describe(itself);
  EXPECT_THAT(itself.err, testing::HasSubstr("d.yaml:1:11: based_on: ./d.yaml is based on this profile itself"));
  const ProgramEnd missing = runSwiftlet({"config", "--system", write("c.yaml", "based_on: swiftlet_4d\n")});
  EXPECT_EQ(missing.exit_code, 2) << describe(missing);
  EXPECT_THAT(missing.err, testing::HasSubstr("c.yaml:1:11: based_on: swiftlet_4d"));
}

}  // namespace
}  // namespace swiftlet::commands
