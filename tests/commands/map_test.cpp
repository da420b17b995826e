// swiftlet map as users meet it: a log of a walk along a room becomes a map, with odometry or without, in any format.
// Logs that are damaged, odd or hostile end it cleanly, with the place of the error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/commands/laser_walk.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kOutputs = {"map.pgm",        "map.yaml",  "map.png",
                                           "trajectory.tum", "graph.g2o", "report.html"};

class Map : public test_support::Scratch {
 protected:
  ProgramEnd map(const std::string& log, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", log, "--out", path("out"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwiftlet(arguments);
  }
  /// Maps the text and returns the figures.
  nlohmann::json mapped(const std::string& log, const std::vector<std::string>& more = {}) const {
    const ProgramEnd end = map(write("a.log", log), more);
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return end.exit_code == 0 ? nlohmann::json::parse(end.out) : nlohmann::json();
  }
  std::string notesOf(const nlohmann::json& figures) const { return figures.at("notes").dump(); }
  /// Expects that the text is refused with exit code 2 and this message, and that no file is left.
  void refused(const std::string& log, const std::string& pattern, const std::vector<std::string>& more = {}) const {
    const ProgramEnd end = map(log, more);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, ContainsRegex(pattern));
    EXPECT_FALSE(fs::exists(path("out"))) << log;
  }
  std::set<std::string> namesIn(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) names.insert(entry.path().filename().string());
    return names;
  }
};

TEST_F(Map, PathLengthIncludesMotionThroughKnownArea) {
  std::string log;
  for (int i = 0; i < 400; ++i) log += scan(-2.0 + 0.03 * std::abs(i % 200 - 100), 100.0 + 0.1 * i);
  for (int i = 400; i < 440; ++i) log += scan(1.0, 100.0 + 0.1 * i);  // The robot stands still.
  EXPECT_NEAR(mapped(log).at("path_length_m").get<double>(), 12.0, 0.4);
}

TEST_F(Map, WritesMapTrajectoryGraphAndReport) {
  const nlohmann::json figures = mapped(walk(100));
  EXPECT_EQ(figures.at("scans"), 100);
  EXPECT_EQ(figures.at("format"), "CARMEN");
  EXPECT_EQ(figures.at("skipped_records"), 0);
  EXPECT_EQ(figures.at("invalid_ranges"), 0);
  EXPECT_EQ(figures.at("unreliable_stamps"), 0);
  EXPECT_TRUE(figures.at("complete").get<bool>());
  EXPECT_TRUE(figures.at("trusted").get<bool>());
  EXPECT_EQ(figures.at("trust_reason"), "the track was never lost");
  EXPECT_TRUE(figures.at("first_skipped_line").is_null());
  EXPECT_TRUE(figures.at("notes").empty()) << figures.dump(2);
  EXPECT_GT(figures.at("scans_per_s").get<double>(), 0.0);
  for (const std::string& name : kOutputs) EXPECT_GT(fs::file_size(folder_ / "out" / name), 100U) << name;

  const std::string trajectory = readText(path("out/trajectory.tum"));
  EXPECT_EQ(
      std::count(trajectory.begin(), trajectory.end(), '\n') - std::count(trajectory.begin(), trajectory.end(), '#'),
      100);
  EXPECT_THAT(trajectory, HasSubstr("\n100.100000000 ")) << "stamped with the log's own time";
  // The last pose of the walk, 2.97 m from the first.
  const std::size_t last = trajectory.rfind('\n', trajectory.size() - 2) + 1;
  EXPECT_NEAR(std::stod(trajectory.substr(trajectory.find(' ', last))), 2.97, 0.05);
}

/// Along the room, then a second without anything in range, then along a room of another size.
std::string walkThroughTheDark() {
  std::string log = walk(60);
  for (int i = 60; i < 70; ++i) log += scan(-2.0 + 0.03 * i, 100.0 + 0.1 * i, 180, 40.0);
  for (int i = 70; i < 130; ++i) log += scan(-2.0 + 0.03 * i, 100.0 + 0.1 * i, 180, 1.7);
  return log;
}

TEST_F(Map, ALostTrackThatStaysUnconnectedIsNotTrusted) {
  const nlohmann::json alone = mapped(walkThroughTheDark(), {"--odometry", "none"});
  EXPECT_TRUE(alone.at("complete").get<bool>()) << "the log was read to its end";
  EXPECT_FALSE(alone.at("trusted").get<bool>());
  EXPECT_THAT(alone.at("trust_reason").get<std::string>(), HasSubstr("the track was lost once, and 1 of its 2 pieces"));
  EXPECT_THAT(notesOf(alone), HasSubstr("the map is probably wrong: the track was lost once"));
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("the map is probably wrong: the track was lost once"));
}

TEST_F(Map, NeedsNoOdometry) {
  const nlohmann::json figures = mapped(walk(100), {"--odometry", "none"});
  EXPECT_EQ(figures.at("scans"), 100);
  const std::string trajectory = readText(path("out/trajectory.tum"));
  const std::size_t last = trajectory.rfind('\n', trajectory.size() - 2) + 1;
  EXPECT_NEAR(std::stod(trajectory.substr(trajectory.find(' ', last))), 2.97, 0.05);
}

TEST_F(Map, TheSameLogGivesTheSameBytes) {
  const std::string log = write("a.log", walk(60));
  for (const char* out : {"one", "two"})
    ASSERT_EQ(runSwiftlet({"map", log, "--out", path(out), "--json"}).exit_code, 0);
  for (const char* name : {"map.pgm", "map.yaml", "trajectory.tum", "graph.g2o"})
    EXPECT_EQ(readText(folder_ / "one" / name), readText(folder_ / "two" / name)) << name;
}

TEST_F(Map, PrintsNotesBeforeTheFigures) {
  const std::string log = write("b.log", walk(30) + "FLASER 3 1.0 2.0\n");
  const ProgramEnd end = runSwiftlet({"map", log, "--out", path("out")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(
      end.out,
      ContainsRegex(
          "note: 1 record could not be read and was skipped, the first in line 33\nnote: .*b\\.log:33:17: range: "
          "the line ends before it, skipped\n(.*\n)*scans +30\n"));
  EXPECT_THAT(end.out, HasSubstr(path("out") + "/report.html"));
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("b.log:33:17"));
}

TEST_F(Map, RefusesFilesThatAreNotLogs) {
  refused(path("none.log"), "none\\.log: cannot be opened: No such file");
  refused(folder_.string(), "is a folder");
  refused(write("empty.log", ""), "empty\\.log: is empty, expected CARMEN");
  refused(write("text.log", "no log\nat all\n"), "text\\.log: not a laser log known here, expected CARMEN");
  refused(write("binary.log", std::string(100'000, '\0') + "\x7f"
                                                           "ELF"),
          "not a laser log known here");
  refused(write("line.log", std::string(5'000'000, 'x')), "not a laser log known here");
  refused(write("cut.gz", std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x01", 11)),
          "cut\\.gz: is cut or damaged");
  refused(write("old.bag", "#ROSBAG V1.2\n"), "old\\.bag: is no bag of version 2\\.0");
}

TEST_F(Map, ALogWithoutScansOrWithoutPointsHasNoMap) {
  refused(write("a.log", "# message\nODOM 1 2 3 0 0 0 1.0 host 1.0\n"), "a\\.log: no map: no scan in it could");
  refused(write("b.log", "FLASER 3 1.0\nFLASER x\n"), "no map: .*first problem: .*b\\.log:1:13: range");
  refused(write("c.log", "FLASER 0 0 0 0 0 0 0 1.0 host 1.0\n"), "no map: none of its 1 scan .*: they have no ranges");
  refused(write("d.log", "FLASER 2 1500 1510 0 0 0 0 0 0 1.0 host 1.0\n"), "2 of 2 ranges are beyond .*in metres");
  refused(write("e.log", "FLASER 2 nan -3 0 0 0 0 0 0 1.0 host 1.0\n"), "2 of 2 ranges are no number or nearer");
}

TEST_F(Map, ASingleScanGivesAMap) {
  const nlohmann::json figures = mapped(scan(0.0, 1.0));
  EXPECT_EQ(figures.at("scans"), 1);
  EXPECT_THAT(figures.at("notes").dump(), HasSubstr("of a single scan"));
  for (const std::string& name : kOutputs) EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
}

TEST_F(Map, SkipsBadRecordsAndMapsTheRest) {
  std::string log = walk(30);
  log += "FLASER 180 1.0 garbage\n" + std::string(200'000, '\xff') + "\n" + std::string(3'000'000, 'F') + "\n";
  log += "FLASER 1e30 1\nFLASER -1 1\nFLASER 1 1 nan 0 0 0 0 0 1.0 host 1.0\nFLASER 1 1 1e300 0 0 0 0 0 1.0 host 1\n";
  for (int i = 30; i < 60; ++i) log += scan(-2.0 + 0.03 * i, 100.0 + 0.1 * i);
  const std::string whole = scan(0.0, 107.0);
  log += whole.substr(0, whole.size() / 2);  // Cut within its last record.
  const nlohmann::json figures = mapped(log);
  EXPECT_EQ(figures.at("scans"), 60);
  EXPECT_EQ(figures.at("skipped_records"), 8);
  EXPECT_THAT(notesOf(figures), HasSubstr("a line of more than 1048576 bytes, skipped"));
  EXPECT_THAT(notesOf(figures), HasSubstr("`garbage` is not a number"));
}

TEST_F(Map, MapsScansOfChangingShapeAndTime) {
  std::string log;
  for (int i = 0; i < 60; ++i) {
    // Beams change; stamps repeat, go back and jump out of all bounds.
    const double stamp_s = i == 20 ? 4.5e9 : i == 21 ? -4.5e9 : i % 10 == 3 ? 100.0 : 100.0 + 0.1 * i;
    std::string line = scan(-2.0 + 0.03 * i, stamp_s, i % 3 == 0 ? 181 : i % 3 == 1 ? 90 : 360);
    if (i == 30) line = "FLASER 4 nan -1 inf 0" + line.substr(line.find(" -1.1"));
    log += line;
  }
  const nlohmann::json figures = mapped(log);
  EXPECT_EQ(figures.at("scans"), 60);
  EXPECT_GE(figures.at("unreliable_stamps").get<int>(), 6);
  EXPECT_EQ(figures.at("invalid_ranges"), 2);
  EXPECT_THAT(notesOf(figures), HasSubstr("time stamps do not follow the one before"));
}

TEST_F(Map, MapsADamagedArchiveUpToTheDamage) {
  const std::string log = write("a.log", walk(200));
  ASSERT_EQ(std::system(("gzip -kf " + log).c_str()), 0);
  const std::string packed = readText(log + ".gz");
  const ProgramEnd end = map(write("cut.log.gz", packed.substr(0, packed.size() * 3 / 4)));
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.err, ContainsRegex("cut\\.log\\.gz:[0-9]+: is cut or damaged, its end cannot be read"));
  const auto figures = nlohmann::json::parse(end.out);
  EXPECT_FALSE(figures.at("complete").get<bool>());
  EXPECT_GT(figures.at("scans").get<int>(), 100);
  EXPECT_LT(figures.at("scans").get<int>(), 200);
  for (const std::string& name : kOutputs) EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
}

TEST_F(Map, ASensorOverridesTheGeometry) {
  const std::string sensor = write("short.yaml", "name: short\nbeams: 180\nfield_of_view_deg: 180\nrange_max_m: 0.5\n");
  refused(write("a.log", walk(5)), "no map: none of its 5 scans", {"--sensor", sensor});
  refused(write("a.log", walk(5)), "urg_04lxx", {"--sensor", "urg_04lxx"});
  EXPECT_EQ(mapped(walk(20), {"--sensor", "utm_30lx"}).at("scans"), 20);
}

TEST_F(Map, RefusesAnUnknownOdometry) {
  const ProgramEnd end = map(write("a.log", walk(5)), {"--odometry", "wheels"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("--odometry"));
}

TEST_F(Map, ReplacesOnlyItsOwnOlderMap) {
  (void)mapped(walk(20));
  EXPECT_EQ(mapped(walk(40)).at("scans"), 40) << "an older map is replaced";

  write("out/mine.txt", "mine");
  const std::string before = readText(path("out/map.yaml"));
  ProgramEnd end = map(write("a.log", walk(20)));
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds `mine.txt`, which is no file of a map"));
  EXPECT_EQ(readText(path("out/map.yaml")), before);

  fs::create_directories(path("theirs"));
  write("theirs/map.yaml", "image: map.pgm\n");
  end = runSwiftlet({"map", path("a.log"), "--out", path("theirs")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds no map of this program"));
  EXPECT_EQ(readText(path("theirs/map.yaml")), "image: map.pgm\n");

  end = runSwiftlet({"map", path("a.log"), "--out", write("file", "")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("is not a folder"));
}

TEST_F(Map, AFailedRunKeepsTheOlderMap) {
  (void)mapped(walk(20));
  const auto all = [&] {
    std::string text;
    for (const std::string& name : kOutputs) text += readText(folder_ / "out" / name);
    return text;
  };
  const std::string before = all();
  test_support::ProgramOptions full_disk;
  full_disk.largest_file_bytes = 10'000;  // Enough for a trajectory, not for a map.
  const ProgramEnd end = runSwiftlet({"map", write("b.log", walk(60)), "--out", path("out")}, full_disk);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_EQ(all(), before);
  EXPECT_EQ(namesIn("out"), std::set<std::string>(kOutputs.begin(), kOutputs.end()));
}

TEST_F(Map, ReplacesLinksInsteadOfFollowingThem) {
  (void)mapped(walk(20));
  const std::vector<std::string> names{"trajectory.tum", "map.yaml", "report.html"};
  for (const std::string& name : names) {
    const std::string own = path("out/" + name), theirs = path("theirs_" + name);
    fs::copy_file(own, theirs);
    fs::remove(own);
    name == "map.yaml" ? fs::create_symlink(theirs, own) : fs::create_hard_link(theirs, own);
  }
  const std::string report = readText(path("theirs_report.html"));
  for (const std::string& name : {names[0], names[1]}) {
    std::ofstream(path("theirs_" + name)) << "theirs";
  }
  (void)mapped(walk(40));
  EXPECT_EQ(readText(path("theirs_trajectory.tum")), "theirs");
  EXPECT_EQ(readText(path("theirs_map.yaml")), "theirs");
  EXPECT_EQ(readText(path("theirs_report.html")), report);
  EXPECT_FALSE(fs::is_symlink(path("out/map.yaml")));
}

TEST_F(Map, FilesOfAKilledRunDoNotBlockTheNext) {
  const std::string log = write("a.log", walk(60));
  test_support::ProgramOptions killed;
  killed.while_running = [](pid_t process, const std::string&) { kill(process, SIGKILL); };
  EXPECT_EQ(runSwiftlet({"map", write("long.log", walk(4000)), "--out", path("out")}, killed).signal, SIGKILL);
  fs::create_directories(path("out/unfinished.part"));
  write("out/unfinished.part/trajectory.tum", "half a l");
  write("out/unfinished.part/map.pgm.123.part", "P5");
  EXPECT_EQ(map(log).exit_code, 0);
  EXPECT_EQ(namesIn("out"), std::set<std::string>(kOutputs.begin(), kOutputs.end()));

  // A folder of that name with other content is not overwritten.
  fs::create_directories(path("theirs/unfinished.part"));
  write("theirs/unfinished.part/mine.txt", "mine");
  const ProgramEnd end = runSwiftlet({"map", log, "--out", path("theirs")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_EQ(readText(path("theirs/unfinished.part/mine.txt")), "mine");
}

TEST_F(Map, RemovesAnOlderGraphWhenTheMethodHasNone) {
  const std::string profile = write("mine.yaml", "autonomy: {estimator: {slam: {method: scan_to_map}}}\n");
  using Arguments = std::vector<std::string>;
  for (const Arguments& without :
       {Arguments{"--slam", "particles"}, Arguments{"--slam", "scan_to_map"}, Arguments{"--system", profile}}) {
    (void)mapped(walk(20), {"--slam", "graph"});
    EXPECT_TRUE(fs::exists(path("out/graph.g2o")));
    (void)mapped(walk(20), without);
    EXPECT_FALSE(fs::exists(path("out/graph.g2o"))) << without.back();
    EXPECT_TRUE(fs::exists(path("out/map.yaml")));
  }
}

TEST_F(Map, AnUnwritableFolderIsRefusedBeforeMapping) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::create_directories(path("out"));
  fs::permissions(path("out"), fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramEnd end = map(write("a.log", walk(20)));
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("Permission denied, give a folder of yours"));
  EXPECT_THAT(end.err, Not(HasSubstr("scans"))) << "no progress was shown";
}

/// Scans without common structure, each far from the one before.
std::string jumps(int scans, double step_m) {
  std::string log;
  unsigned noise = 1;
  for (int i = 0; i < scans; ++i) {
    log += "FLASER 45";
    for (int beam = 0; beam < 45; ++beam) {
      noise = noise * 1664525u + 1013904223u;
      log += fmt::format(" {:.2f}", 1.0 + 20.0 * (noise >> 8) / (1u << 24));
    }
    log += fmt::format(" {0:.2f} 0 0 {0:.2f} 0 0 {1}.0 host {1}.0\n", step_m * i, 100 + i);
  }
  return log;
}

TEST_F(Map, AMapTooLargeToReadIsNotWritten) {
  const ProgramEnd end = map(write("a.log", jumps(200, 9.0)));
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.err, ContainsRegex("the map would be 3[0-9]{4} by [0-9]+ cells of 0\\.05 m: the log's odometry or "
                                     "scans jump; trajectory and graph are written, the map is not"));
  EXPECT_THAT(notesOf(nlohmann::json::parse(end.out)), HasSubstr("the map would be"));
  EXPECT_EQ(namesIn("out"), (std::set<std::string>{"graph.g2o", "report.html", "trajectory.tum"}));
}

TEST_F(Map, AMapOfScansThatDoNotMatchIsNotTrusted) {
  EXPECT_THAT(notesOf(mapped(jumps(30, 1.0))), HasSubstr("the map is probably wrong: the track was lost 7 times"));
}

TEST_F(Map, ReportsStampsThatAreAllTheSame) {
  std::string log;
  for (int i = 0; i < 20; ++i) log += scan(-2.0 + 0.03 * i, 0.0);
  const std::string notes = notesOf(mapped(log));
  EXPECT_THAT(notes, HasSubstr("all scans have the same stamp, 0.000 s"));
  EXPECT_THAT(notes, Not(HasSubstr("time stamps do not follow")));
}

TEST_F(Map, ReportsAnUnwritableTemporaryFile) {
  test_support::ProgramOptions full_disk;
  full_disk.largest_file_bytes = 3000;
  // Few enough scans that all of them wait in memory until they are read.
  const ProgramEnd end = runSwiftlet({"map", write("a.log", walk(80)), "--out", path("out"), "--json"}, full_disk);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("temporary file of the trajectory cannot be written"));
}

TEST_F(Map, NamesTheFolderAfterTheLogWithoutItsExtensions) {
  test_support::ProgramOptions here;
  here.working_folder = folder_.string();
  for (const char* name : {"day.01.clf", "day.02.clf", "noending"}) write(name, walk(5));
  ASSERT_EQ(std::system(("gzip -k " + path("day.02.clf")).c_str()), 0);
  for (const char* name : {"day.01.clf", "day.02.clf.gz", "noending"})
    EXPECT_EQ(runSwiftlet({"map", name, "--json"}, here).exit_code, 0) << name;
  for (const char* folder : {"day.01-map", "day.02-map", "noending-map"})
    EXPECT_TRUE(fs::exists(folder_ / folder / "map.yaml")) << folder;
}

TEST_F(Map, ReportsAFullDisk) {
  test_support::ProgramOptions full_disk;
  full_disk.largest_file_bytes = 3000;
  const ProgramEnd end = runSwiftlet({"map", write("a.log", walk(100)), "--out", path("out"), "--json"}, full_disk);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, testing::AnyOf(HasSubstr("too large"), HasSubstr("cannot be written")));
}

}  // namespace
}  // namespace swiftlet::commands
