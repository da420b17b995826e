// swiftlet localize as users meet it: a log is localized in a map, a log of another place is not, and unusable input is
// refused.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/random.hpp"
#include "tests/localization/buildings.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

/// Which pose of a record contains the odometry.
enum class Odometry { kOfBoth, kOfLaser };

/// A walk of `steps` scans, five a second, as a CARMEN log; its odometry has an origin of its own.
std::string walkThrough(const test::Building& building, std::uint64_t seed, int steps,
                        Odometry odometry_of = Odometry::kOfBoth) {
  const test::Walks walks(building);
  test::Walker walker(walks, seed, 0.6);
  test::DriftingOdometry odometry(seed);
  common::RandomStream random(seed, "log");
  std::string log;
  for (int i = 0; i < steps; ++i) {
    const common::Pose2 pose = walker.pose();
    log += "FLASER 180";
    for (int beam = 0; beam < 180; ++beam) {
      const double angle = pose.yaw_rad + (beam - 90) * common::kRadPerDeg;
      const double range = building.world.cast({pose.x_m, pose.y_m, 1.0}, {std::cos(angle), std::sin(angle), 0.0});
      log += fmt::format(" {:.3f}", range + random.gaussian(0.015));
    }
    const common::Pose2& odom = odometry.pose();
    const std::string at = fmt::format(" {:.4f} {:.4f} {:.5f}", odom.x_m, odom.y_m, odom.yaw_rad);
    const std::string robot_at = odometry_of == Odometry::kOfLaser ? " 0 0 0" : at;
    log += fmt::format("{}{} {:.2f} robot {:.2f}\n", at, robot_at, 100.0 + 0.2 * i, 0.2 * i);
    walker.advance(0.2);
    odometry.step(between(pose, walker.pose()));
  }
  return log;
}

class Localize : public test_support::Scratch {
 protected:
  std::string writeMapOf(const test::Building& building, const std::string& name) {
    const common::OccupancyGrid grid = test::mapOf(building);
    const common::CellRect known = common::knownExtent(grid);
    std::string pgm = fmt::format("P5\n{} {}\n255\n", known.width(), known.height());
    for (int y = known.end.y - 1; y >= known.begin.y; --y)
      for (int x = known.begin.x; x < known.end.x; ++x) {
        const auto cell = grid.at({x, y});
        pgm += static_cast<char>(common::occupancy::isUnknown(cell)    ? 205
                                 : common::occupancy::isOccupied(cell) ? 0
                                                                       : 254);
      }
    write(name + ".pgm", pgm);
    return write(name + ".yaml",
                 fmt::format("image: {}.pgm\nresolution: 0.05\norigin: [{:.3f}, {:.3f}, 0.0]\nnegate: 0\n"
                             "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                             name, known.begin.x * 0.05, known.begin.y * 0.05));
  }
  /// Expects a refusal with this message, and that nothing was written.
  void expectRefused(const std::vector<std::string>& arguments, const std::string& message) {
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(path("out"))) << message;
  }
};

TEST_F(Localize, ALogIsLocalizedInItsMap) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map"), log = write("walk.log", walkThrough(building, 21, 150));
  const ProgramEnd end = runSwiftlet({"localize", map, log, "--out", path("out"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json.at("scans"), 150);
  EXPECT_EQ(json.at("times_localized"), 1);
  EXPECT_EQ(json.at("times_lost"), 0);
  EXPECT_TRUE(json.at("losses").empty());
  EXPECT_EQ(json.at("wrong_map"), false);
  EXPECT_NEAR(json.at("localized_share"), json.at("localized_scans").get<int>() / 150.0, 1e-4);
  EXPECT_EQ(json.at("state_at_end"), "localized");
  EXPECT_GE(json.at("localized_scans").get<int>(), 75);
  EXPECT_TRUE(json.at("complete").get<bool>());
  EXPECT_TRUE(json.at("notes").empty()) << json.dump(2);
  const std::string trajectory = readText(path("out/trajectory.tum"));
  EXPECT_EQ(std::count(trajectory.begin(), trajectory.end(), '\n'), json.at("localized_scans").get<int>());
  EXPECT_THAT(trajectory, HasSubstr("129.8")) << "stamped as the log is";
  EXPECT_THAT(readText(path("out/events.jsonl")), HasSubstr("\"localized\""));
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("<svg"));
  EXPECT_GT(std::filesystem::file_size(path("out/map.png")), 1000U);

  // The same seed, the same bytes.
  ASSERT_EQ(runSwiftlet({"localize", map, log, "--out", path("again"), "--json"}).exit_code, 0);
  EXPECT_EQ(readText(path("again/trajectory.tum")), trajectory);
}

TEST_F(Localize, ALogOfAnotherFloorIsNeverLocalized) {
  const std::string map = writeMapOf(test::offices(21), "map");
  const ProgramEnd end =
      runSwiftlet({"localize", map, write("walk.log", walkThrough(test::hall(22), 22, 100)), "--out", path("out")});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("never localized"));
}

TEST_F(Localize, SaysThatTheMapIsOfAnotherPlace) {
  const std::string map = writeMapOf(test::offices(21), "map");
  const std::string log = walkThrough(test::offices(22), 22, 250);
  const ProgramEnd end = runSwiftlet({"localize", map, write("walk.log", log), "--out", path("out"), "--json"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json.at("wrong_map"), true);
  EXPECT_EQ(json.at("localized_share"), 0.0);

  const std::string begin = log.substr(0, log.find('\n', log.size() / 50) + 1);
  const ProgramEnd soon = runSwiftlet({"localize", map, write("begin.log", begin), "--out", path("out"), "--json"});
  EXPECT_EQ(nlohmann::json::parse(soon.out).at("wrong_map"), nullptr) << describe(soon);
}

TEST_F(Localize, SaysWhereItWasLost) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map");
  // Carried to where another walk begins, while the odometry stands still.
  std::string log = walkThrough(building, 21, 150);
  log += walkThrough(building, 24, 150);
  const ProgramEnd end = runSwiftlet({"localize", map, write("walk.log", log), "--out", path("out"), "--json"});
  const auto json = nlohmann::json::parse(end.out);
  ASSERT_EQ(json.at("times_lost"), 1) << json.dump(2);
  EXPECT_EQ(json.at("wrong_map"), false);
  const auto& loss = json.at("losses").at(0);
  EXPECT_GE(loss.at("scan").get<int>(), 150);
  EXPECT_LT(loss.at("scan").get<int>(), 165);
  EXPECT_GT(loss.at("scans_lost").get<int>(), 0);
  EXPECT_FALSE(loss.at("reason").get<std::string>().empty());
  std::istringstream trajectory(readText(path("out/trajectory.tum")));
  double t = 0, x = 0, y = 0, nearest = 1e9;
  for (std::string line; std::getline(trajectory, line);)
    if (std::sscanf(line.c_str(), "%lf %lf %lf", &t, &x, &y) == 3)
      nearest = std::min(nearest, std::hypot(x - loss.at("x_m").get<double>(), y - loss.at("y_m").get<double>()));
  EXPECT_LT(nearest, 0.01) << "one of its poses";
}

TEST_F(Localize, ReadsTheFormatsThatMapReads) {
  const std::string formats = "CARMEN, BreezySLAM .dat or rosbag 1; plain, or packed by";
  for (const std::string command : {"map", "localize"})
    EXPECT_THAT(runSwiftlet({command, "--help"}).out, HasSubstr(formats)) << command;
}

TEST_F(Localize, ReportsOdditiesOfTheLog) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map");
  const std::string log = write("odd.log", walkThrough(building, 21, 150, Odometry::kOfLaser) + "FLASER 3 1.0 \xff\n");
  const ProgramEnd told = runSwiftlet({"localize", map, log, "--out", path("out")});
  EXPECT_EQ(told.exit_code, 0) << describe(told);
  EXPECT_THAT(told.out, HasSubstr("note: the robot's pose never changes"));
  EXPECT_THAT(told.out, HasSubstr("note: 1 record could not be read and was skipped, the first in line"));
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("the robot&#39;s pose never changes"));

  const ProgramEnd figures = runSwiftlet({"localize", map, log, "--out", path("out"), "--json"});
  EXPECT_EQ(figures.exit_code, 0) << describe(figures);
  EXPECT_THAT(nlohmann::json::parse(figures.out).at("notes").dump(), HasSubstr("the robot's pose never changes"));
}

TEST_F(Localize, ShowsTheNotesOfTheMapAndOfItsStamps) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map"), yaml = readText(map) + "width: 3\n";
  std::string log;
  std::istringstream lines(walkThrough(building, 21, 150));
  // The stamps, 100.00 and so on, as milliseconds.
  for (std::string line; std::getline(lines, line);) {
    const std::size_t dot = line.find(" robot");
    log += line.substr(0, dot - 3) + line.substr(dot - 2, 2) + "0" + line.substr(dot) + "\n";
  }
  const ProgramEnd end =
      runSwiftlet({"localize", write("map.yaml", yaml), write("ms.log", log), "--out", path("out"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string notes = nlohmann::json::parse(end.out).at("notes").dump();
  EXPECT_THAT(notes, HasSubstr("unknown key `width`, not used"));
  EXPECT_THAT(notes, HasSubstr("are they milliseconds? Then divide them by 1e3"));
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("unknown key `width`, not used"));
}

TEST_F(Localize, LocalizesADamagedArchiveUpToTheDamage) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map"), log = write("walk.log", walkThrough(building, 21, 200));
  ASSERT_EQ(std::system(("gzip -kf " + log).c_str()), 0);
  const std::string packed = readText(log + ".gz");
  const ProgramEnd end = runSwiftlet(
      {"localize", map, write("cut.log.gz", packed.substr(0, packed.size() * 3 / 4)), "--out", path("out"), "--json"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("is cut or damaged, its end cannot be read"));
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_FALSE(json.at("complete").get<bool>());
  EXPECT_EQ(json.at("times_localized"), 1);
  EXPECT_LT(json.at("scans").get<int>(), 200);
  for (const char* name : {"trajectory.tum", "events.jsonl", "map.png", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name)) << name;
}

TEST_F(Localize, ReplacesOnlyItsOwnOlderResults) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map"), log = write("walk.log", walkThrough(building, 21, 100));
  const auto localize = [&](const std::string& out) { return runSwiftlet({"localize", map, log, "--out", path(out)}); };
  ASSERT_EQ(localize("out").exit_code, 0);
  const std::string trajectory = readText(path("out/trajectory.tum"));
  write("out/trajectory.tum", "old");
  EXPECT_EQ(localize("out").exit_code, 0) << "older results are replaced";
  EXPECT_EQ(readText(path("out/trajectory.tum")), trajectory);

  write("out/mine.txt", "mine");
  write("out/trajectory.tum", "old");
  ProgramEnd end = localize("out");
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds `mine.txt`, which is no file of a localization"));
  EXPECT_EQ(readText(path("out/trajectory.tum")), "old");

  ASSERT_EQ(runSwiftlet({"map", log, "--out", path("mapped")}).exit_code, 0);
  const std::string report = readText(path("mapped/report.html"));
  end = localize("mapped");
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("which is no file of a localization"));
  EXPECT_EQ(readText(path("mapped/report.html")), report);

  for (const char* name : {"map.pgm", "map.yaml", "graph.g2o"}) std::filesystem::remove(folder_ / "mapped" / name);
  end = localize("mapped");
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds no localization of this program"));
  EXPECT_EQ(readText(path("mapped/report.html")), report);
}

TEST_F(Localize, AWrongStartThatIsNotRecoveredIsAFailure) {
  const test::Building building = test::offices(21), other = test::offices(22);
  const std::string map = writeMapOf(building, "map"), log = write("walk.log", walkThrough(other, 22, 100));
  const ProgramEnd end = runSwiftlet({"localize", map, log, "--start", "5;0;0", "--out", path("out"), "--json"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json.at("times_localized"), 1) << "what was given";
  EXPECT_EQ(json.at("times_lost"), 1);
  EXPECT_NE(json.at("wrong_map"), false);
}

TEST_F(Localize, RefusesUnusableInput) {
  const test::Building building = test::offices(21);
  const std::string map = writeMapOf(building, "map"), log = write("walk.log", walkThrough(building, 21, 2));
  expectRefused({"localize", path("none.yaml"), log}, "none.yaml");
  expectRefused({"localize", write("bad.yaml", "image: map.pgm\nresolutoin: 0.05\n"), log},
                "did you mean `resolution`?");
  write("black.pgm", "P5\n2 2\n255\n" + std::string(4, '\0'));
  expectRefused({"localize", write("black.yaml", "image: black.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"), log},
                "no free cells");
  expectRefused({"localize", map, path("none.log")}, "none.log");
  expectRefused({"localize", map, write("empty.log", "ODOM 0 0 0 0 0 0 1.0 robot 1.0\n"), "--out", path("out")},
                "no scan");
  expectRefused({"localize", map, log, "--start", "1;2", "--out", path("out")},
                "--start: `1;2` is not a place x;y;yaw");
  for (const char* start : {"1e300;0;0", "-90;0;0", "0;200;0"})
    expectRefused({"localize", map, log, "--start", start, "--out", path("out")}, "lies outside the map");
  expectRefused({"localize", map, log, "--odometry", "wheels"}, "--odometry");
}

TEST_F(Localize, ALogWithoutPointsIsNotLocalizedWhateverTheStart) {
  const std::string map = writeMapOf(test::offices(21), "map");
  std::string text;
  for (int i = 0; i < 20; ++i) text += fmt::format("FLASER 2 81.9 81.9 0 0 0 0 0 0 {0}.0 host {0}.0\n", i);
  const std::string log = write("blind.log", text);
  expectRefused({"localize", map, log, "--start", "5;2;0", "--out", path("out")},
                "not localized: none of its 20 scans has points enough");
  expectRefused({"localize", map, log, "--out", path("out")}, "not localized: none of its 20 scans");
}

TEST_F(Localize, LabelsEventsByScanWhenThereAreNoStamps) {
  const test::Building building = test::offices(21);
  std::istringstream lines(walkThrough(building, 21, 120));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t before_stamp = line.rfind(' ', line.find(" robot ") - 1);
    text += line.substr(0, before_stamp) + " 0 robot 0\n";
  }
  const ProgramEnd end =
      runSwiftlet({"localize", writeMapOf(building, "map"), write("same.log", text), "--out", path("out")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("note: all scans have the same stamp, 0.000 s"));
  EXPECT_THAT(end.out, testing::ContainsRegex("\nscan [0-9]+  localized: "));
  EXPECT_THAT(readText(path("out/report.html")), testing::ContainsRegex(">scan [0-9]+<"));
}

}  // namespace
}  // namespace swiftlet::commands
