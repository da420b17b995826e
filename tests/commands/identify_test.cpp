// identify, tune and papers: what they make of a flight, and their messages about what they cannot use.
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config.hpp"
#include "control/vehicle_model.hpp"
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
using testing::ContainsRegex;
using testing::HasSubstr;

class Identify : public Refusals {
 protected:
  /// A short flight with everything that identify and tune read.
  std::string hop(const std::string& run, const std::string& mission = kHop) const {
    const ProgramEnd end = runSwiftlet({"fly", write("hop.xml", missionWith(mission)), "--headless", "--nature", "real",
                                        "--seed", "4", "--control-log", "--out", path(run)});
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return path(run);
  }
  std::string profile(const std::string& lines) const {
    return write("mine.yaml", "vehicle: cobra\nlaser: utm_30lx\n" + lines);
  }
};

TEST_F(Identify, TellsWhatAFlightIsTooShortFor) {
  const std::string run = hop("run");
  EXPECT_TRUE(fs::exists(run + "/control.tsv") && fs::exists(run + "/fusion.tsv"));
  const ProgramEnd end = runSwiftlet({"identify", run, "--bench", "--out", path("model.yaml")});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("not identified: forward: "));
  EXPECT_THAT(end.out, HasSubstr("are needed"));
}

TEST_F(Identify, RefusesWhatIsNoFlightOfThatVehicle) {
  expectRefused(runSwiftlet({"identify", path("nowhere")}), "nowhere: is not a folder");
  fs::create_directory(path("empty"));
  expectRefused(runSwiftlet({"identify", path("empty")}), "empty: is not the folder of a run");
  const std::string run = hop("run");
  expectRefused(runSwiftlet({"identify", run, "--vehicle", "pelican"}),
                "`cobra` flew, not `pelican`, give --vehicle cobra");
  expectRefused(runSwiftlet({"consistency", run, "--system", "dlr"}), "flew, not .*give a --system whose vehicle is");
  fs::remove(run + "/control.tsv");
  expectRefused(runSwiftlet({"identify", run}), "has no control.tsv, fly it with --control-log");
  expectRefused(runSwiftlet({"tune", run}), "--held-out: names no flight");
}

TEST_F(Identify, TuneRefusesAFlightWithoutTheTruthOrTooShort) {
  const std::string run = hop("run");
  const std::string log = readText(run + "/control.tsv");
  // The 16th word of each line says whether the truth follows.
  std::string without;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    int number = 0;
    for (std::string word; words >> word; ++number) without += (number == 15 && line[0] != '#' ? "0" : word) + " ";
    without += "\n";
  }
  write("run/control.tsv", without);
  fs::copy(run, path("other"));
  const std::vector<std::string> tune{"tune", run, "--held-out", path("other")};
  expectRefused(runSwiftlet(tune), "control.tsv: has no truth at [0-9.]+ s, in flight, only flights of the simulator");
  write("run/control.tsv", log);
  expectRefused(runSwiftlet(tune), "run: [0-9.]+ s of flight are too few, at least 15 s are needed");
  expectRefused(runSwiftlet({"tune", run, "--held-out", run}), "--held-out: .*run is learned from too");
  write("run/fusion.tsv", "imu 1 2 3\n");
  expectRefused(runSwiftlet(tune), "fusion.tsv:1:1: is no input of the filter");
}

/// Long enough to compare the errors of the filter.
const std::string kStay = "      <TakeOff height_m=\"1.0\"/>\n      <Sleep msec=\"6000\"/>\n      <Land/>\n";

TEST_F(Identify, TheDriftOfAccelerationAloneIsPlotted) {
  const std::string run = hop("run", kStay);
  const ProgramEnd end = runSwiftlet({"consistency", run, "--drift", path("drift.svg")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out,
              ContainsRegex("the integrated acceleration is off by [0-9.]+ m/s, the filter by 0\\.[0-9]+ m/s"));
  EXPECT_THAT(readText(path("drift.svg")), HasSubstr("integrated acceleration"));
}

TEST_F(Identify, TheDriftOfAFilterThatNeverStartedIsRefused) {
  const std::string run = hop("run", kStay);
  std::istringstream tape(readText(run + "/fusion.tsv"));
  std::string without;
  for (std::string line; std::getline(tape, line);)
    if (!line.starts_with("start ")) without += line + "\n";
  write("run/fusion.tsv", without);
  expectRefused(runSwiftlet({"consistency", run, "--drift", path("drift.svg")}),
                "run: --drift: its filter never started while the truth was known, put a run first that took off");
  EXPECT_FALSE(fs::exists(path("drift.svg")));
}

/// Of an instant alone a covariance is neither right nor wrong.
TEST_F(Identify, TheConsistencyOfAHopIsRefused) {
  expectRefused(runSwiftlet({"consistency", hop("run")}),
                "run: 0\\.[0-9] s of flight are too few, at least 5 s are needed");
}

TEST_F(Identify, TuneSearchesGainsThatCanBeNamed) {
  const std::string out = path("found.yaml");
  const auto tune = [&](const std::string& flights, const std::string& only) {
    test_support::ProgramOptions options;
    options.working_folder = path(".");
    return runSwiftlet({"tune", "--gains", "trials/papers/gains.yaml", "--system", "unb", "--seeds", "1", "--flights",
                        flights, "--only", only, "--out", out},
                       options);
  };
  const ProgramEnd end = tune("2", "horizontal");
  EXPECT_NE(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.out, ContainsRegex("set   2  cost [0-9.]+  best [0-9.]+\n"));
  EXPECT_THAT(end.out, testing::Not(HasSubstr("set   3")));
  EXPECT_THAT(end.out, testing::Not(HasSubstr("vertical")));
  EXPECT_EQ(runSwiftlet({"config", "--system", out}).exit_code, 0);
  expectRefused(tune("2", "sideways"), "--only: no gain of unb begins with `sideways`");
  expectRefused(runSwiftlet({"tune", "--gains", "trials/papers/gains.yaml", "--system", "unb", "--flights", "5"}),
                "--flights: is too few for two sets of gains");
  expectRefused(runSwiftlet({"tune", "--gains", "trials/papers/unb_case1.yaml"}), "phases: is missing");
  expectRefused(runSwiftlet({"tune"}), "run: names no flight");
}

TEST_F(Identify, AProfileWhoseControllerOrModelDoesNotFitIsRefusedWithItsPlace) {
  const auto fly = [&](const std::string& profile_lines) {
    return runSwiftlet({"fly", write("hop.xml", missionWith(kHop)), "--headless", "--system", profile(profile_lines),
                        "--out", path("run")});
  };
  expectRefused(fly("autonomy: {control: {controller: {kind: lqq}}}\n"), "mine.yaml:3:.*did you mean `lqr`");
  expectRefused(fly("autonomy:\n  control:\n    controller: {kind: lqr}\n"),
                "mine.yaml:5:24: autonomy.control.controller.kind: lqr needs a vehicle_model.*swiftlet identify");
  expectRefused(fly("vehicle_model: nowhere\n"), "mine.yaml:3:16: vehicle_model: nowhere: ");
  control::VehicleModel model;
  model.version = 1;
  model.vehicle = "pelican";
  model.battery_full_v = 16.8;
  model.thrust = {{11.0, 0.6, 9.0}, {12.0, 0.5, 9.0}};
  const auto put = [&] {
    write("model.yaml", common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(model));
  };
  put();
  const ProgramEnd end = fly("vehicle_model: model.yaml\n");
  expectRefused(
      end, "mine.yaml:3:16: vehicle_model: .*model.yaml:2:10: vehicle: the model is of `pelican`, but `cobra` flies");
  expectRefused(end, "a battery of 16.8 V, but that of `cobra` has 12.6 V");
  model.vehicle = "cobra";
  model.battery_full_v = 12.6;
  model.battery_empty_v = 10.2;
  model.battery_capacity_ah = 5;
  model.thrust = {{21.0, 0.6, 9.0}, {22.0, 0.5, 9.0}};
  put();
  expectRefused(
      fly("vehicle_model: model.yaml\n"),
      "mine.yaml:3:16: vehicle_model: .*model.yaml:[0-9]+:[0-9]+: thrust\\[0\\].voltage_v: 21 V is of another");
  model.thrust.clear();
  model.bench_roll = {{-180, 59}, {180, 60}};
  put();
  expectRefused(fly("vehicle_model: model.yaml\n"),
                "model.yaml:[0-9]+:[0-9]+: bench_roll\\[1\\].angle_deg: changes by");
  model.bench_roll.clear();
  model.forward.gain = -8.4;
  put();
  expectRefused(fly("vehicle_model: model.yaml\n"),
                "model.yaml:[0-9]+:[0-9]+: forward.gain: -8.4 is not within 3 and 30");
  EXPECT_FALSE(fs::exists(path("run")));
}

/// Without a model of its axes no operator may switch to lqr either.
TEST_F(Identify, ATrialThatSwitchesToLqrNeedsItsModel) {
  control::VehicleModel model;
  model.version = 1;
  model.vehicle = "cobra";
  write("model.yaml", common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(model));
  const std::string trial = write("switch.yaml", "mission: " + write("hop.xml", missionWith(kHop)) +
                                                     "\nsystem: " + profile("vehicle_model: model.yaml\n") +
                                                     "\nscenario: {world: worlds/unb_case1.sdf}\noperator:\n  - "
                                                     "{command: controller, controller: lqr, at_s: 3}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("out")}),
                "switch.yaml:5:15: trial switch: operator: controller: profile .*lqr needs every axis, but model.yaml");
}

TEST_F(Identify, NoFileOfAnythingElseIsReplaced) {
  const std::string run = hop("run"), mission = path("hop.xml"), before = readText(mission);
  const auto refused = [&](std::vector<std::string> arguments, const std::string& option) {
    const auto with = [&](const std::string& out) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {option, out});
      return runSwiftlet(all);
    };
    expectRefused(with(mission), "hop.xml: " + option + ": is there already, and does not begin with `# ");
    expectRefused(with(path("nowhere/x.yaml")), option + ": its folder does not exist, make the folder first");
    expectRefused(with(path(".")), option + ": is a folder");
  };
  refused({"identify", run}, "--out");
  refused({"tune", run, "--held-out", run}, "--out");
  refused({"tune", "--gains", "trials/papers/gains.yaml", "--system", "unb"}, "--out");
  refused({"papers"}, "--write");
  EXPECT_EQ(readText(mission), before);
  const std::string page = path("page.md");
  for (int time = 0; time < 2; ++time) EXPECT_EQ(runSwiftlet({"papers", "--write", page}).exit_code, 0) << time;
}

TEST_F(Identify, AFlightGivenTwiceIsRefused) {
  const std::string run = hop("run"), again = path("./run/");
  expectRefused(runSwiftlet({"identify", run, again}), "run: .*run/ is given twice, and counts as one flight");
  expectRefused(runSwiftlet({"tune", run, again, "--held-out", "other"}), "run: .* is given twice");
  expectRefused(runSwiftlet({"tune", "other", "--held-out", run, "--held-out", again}),
                "--held-out: .* is given twice");
  expectRefused(runSwiftlet({"consistency", run, again}), "run: .* is given twice");
}

TEST_F(Identify, ALogWithStampsInAnotherUnitIsRefused) {
  const std::string run = hop("run");
  std::istringstream lines(readText(run + "/control.tsv"));
  std::string slow;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(' ');
    slow += (line[0] == '#' ? line : std::to_string(1000.0 * std::stod(line.substr(0, end))) + line.substr(end)) + "\n";
  }
  write("run/control.tsv", slow);
  expectRefused(runSwiftlet({"identify", run}),
                "control.tsv: its rows are 10 s apart, and a flight writes one each 0.01 s");
}

TEST_F(Identify, TheBenchNeedsThePlantThatFlew) {
  const std::string run = hop("run");
  fs::remove(run + "/nature.yaml");
  expectRefused(runSwiftlet({"identify", run, "--bench"}), "run: --bench: has no nature.yaml");
}

TEST_F(Identify, ThePageOfThePapersHasARowForEachExperiment) {
  const ProgramEnd printed = runSwiftlet({"papers"});
  ASSERT_EQ(printed.exit_code, 0) << describe(printed);
  const auto firstCells = [](const std::string& page) {
    std::string cells;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("| ")) continue;
      std::size_t end = 0;
      for (int bar = 0; bar < 3; ++bar) end = line.find(" |", end + 1);
      cells += line.substr(0, end) + "\n";
    }
    return cells;
  };
  EXPECT_EQ(firstCells(readText(fs::path(SWIFTLET_SOURCE_DIR) / "docs/papers.md")), firstCells(printed.out))
      << "update it: swiftlet papers --results RESULTS --write docs/papers.md";
  expectRefused(runSwiftlet({"papers", "--results", write("results.json", "{}")}), "is not the results.json of trials");
}

TEST_F(Identify, ResultsThatNoTrialWroteAreRefusedWithTheirPlace) {
  const auto refused = [&](const std::string& trials, const std::string& pattern) {
    expectRefused(runSwiftlet({"papers", "--results", write("r.json", R"({"trials": [)" + trials + "]}")}), pattern);
  };
  refused("", "r.json: trials: is empty");
  refused("5", R"(r.json: trials\[0\]: is no object)");
  refused(R"({"name": 7})", R"(r.json: trials\[0\].name: is no text)");
  refused(R"({}, {"flights": 5})", R"(r.json: trials\[1\].flights: is no list)");
  refused(R"({"flights": [{"phases": []}]})", R"(trials\[0\].flights\[0\].phases: is no object)");
  refused(R"({"runs": -3})", R"(trials\[0\].runs: -3 is no number of flights)");
  refused(R"({"name": "mit_hover", "system": "mit", "flights": [{"phases": {"hover": {"position_rms_m": 1e308}}}]})",
          R"(trials\[0\].flights\[0\].phases.hover.position_rms_m: 1e\+308 is no figure)");
  const ProgramEnd unused = runSwiftlet({"papers", "--results", write("r.json", R"({"trials": [{"name": "mine"}]})")});
  EXPECT_EQ(unused.exit_code, 0) << describe(unused);
  EXPECT_THAT(unused.err, ContainsRegex(R"(note: .*r.json: trials\[0\]: no row is of `mine`)"));
}

TEST_F(Identify, ThePageOfThePapersShowsEveryNatureAndWhatFallsShort) {
  const auto flown = [](const std::string& name, const std::string& system, const std::string& rms_m) {
    return R"({"name": ")" + name + R"(", "system": ")" + system +
           R"(", "runs": 1, "flights": [{"phases": {"hover": {"position_rms_m": )" + rms_m + "}}}]}";
  };
  const std::string results = write("two.json", R"({"trials": [)" + flown("mit_hover-mit-mit", "mit", "0.02") + ", " +
                                                    flown("mit_hover-mit-real", "mit", "0.5") + ", " +
                                                    flown("mit_hover-swiftlet", "swiftlet", "0.01") + "]}");
  const ProgramEnd printed = runSwiftlet({"papers", "--results", results});
  ASSERT_EQ(printed.exit_code, 0) << describe(printed);
  EXPECT_THAT(printed.out,
              HasSubstr("| 6 cm RMS | 0.020 (n = 1), mit-mit; 0.500 (n = 1), mit-real: more than twice the "
                        "paper's, why is not known | 0.010 (n = 1) |"));
}

TEST_F(Identify, ThePageOfThePapersKeepsTheFiguresOfTrialsThatWereNotFlownAgain) {
  const auto results = [&](const std::string& system, const std::string& rms_m) {
    return write("one.json", R"({"trials": [{"name": "mit_hover-)" + system + R"(", "system": ")" + system +
                                 R"(", "runs": 1, "flights": [{"phases": {"hover": {"position_rms_m": )" + rms_m +
                                 "}}}]}]}");
  };
  const std::string page = (fs::path(folder_) / "page.md").string();
  for (const auto& [system, rms_m] : {std::pair("mit", "0.01"), {"swiftlet", "0.02"}, {"swiftlet", "0.03"}}) {
    const ProgramEnd end = runSwiftlet({"papers", "--results", results(system, rms_m), "--write", page});
    ASSERT_EQ(end.exit_code, 0) << describe(end);
  }
  EXPECT_THAT(readText(page), HasSubstr("| 6 cm RMS | 0.010 (n = 1) | 0.030 (n = 1) |"));
}

class PageOfThePapers : public Identify {
 protected:
  /// The page with the results of one trial with ours: `members` of the trial beside its name and system.
  std::string pageWith(const std::string& name, const std::string& members) {
    const std::string results = R"({"trials": [{"name": ")" + name + R"(", "system": "swiftlet", )" + members + "}]}";
    const ProgramEnd printed = runSwiftlet({"papers", "--results", write("results.json", results)});
    EXPECT_EQ(printed.exit_code, 0) << describe(printed);
    return printed.out;
  }
  static std::string hover(const std::string& rms_m, int collisions = 0) {
    return R"({"collisions": )" + std::to_string(collisions) + R"(, "phases": {"hover": {"position_rms_m": )" + rms_m +
           "}}}";
  }
};

TEST_F(PageOfThePapers, CountsFlightsThatLackTheFigureOrCrashedAsFailed) {
  const std::string flights = R"("flights": [)" + hover("0.01") + ", " + hover("0.02") + ", " + hover("0.03") + ", ";
  EXPECT_THAT(pageWith("mit_hover-swiftlet", flights + R"({"phases": {}}])"), HasSubstr("| 0.020 (n = 4, 1 failed) |"));
  EXPECT_THAT(pageWith("mit_hover-swiftlet", flights + hover("0.9", 1) + "]"), HasSubstr("| 0.020 (n = 4, 1 failed) |"))
      << "a hover that ends in a crash is none";
  EXPECT_THAT(
      pageWith("mit_hover-swiftlet", flights + hover("null") + ", " + hover("null") + ", " + hover("null") + "]"),
      HasSubstr("| - (n = 6, 3 failed) |"))
      << "half of the flights have no median";
}

TEST_F(PageOfThePapers, CountsFailedFlightsOfFiguresOfTheWholeTrial) {
  const std::string runs = R"("runs": 4, "goal_error_max_m": 0.05, "mission_time_median_s": 60, )";
  const std::string without = R"("seeds_without": {"goal_error_max_m": [7]}, )";
  const std::string flights = R"("flights": [{"seed": 7, "collisions": 1}, {"seed": 8, "collisions": 1}, {"seed": 9}])";
  const std::string page = pageWith("unb_case1-swiftlet", runs + without + flights);
  EXPECT_THAT(page, HasSubstr("| - (n = 4, 2 failed) |")) << "the one that lacks it, and one that crashed";
  EXPECT_THAT(pageWith("unb_case1-swiftlet", runs + without + R"("flights": [{"seed": 7, "collisions": 1}])"),
              HasSubstr("| 0.050 (n = 4, 1 failed) |"));
}

TEST_F(PageOfThePapers, NamesCodeThatExists) {
  std::istringstream lines(runSwiftlet({"papers"}).out);
  int named = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ") || line.starts_with("| ---") || line.starts_with("| in the paper")) continue;
    const std::size_t end = line.rfind(" |"), begin = line.rfind("| ", end - 1);
    std::istringstream files(line.substr(begin + 2, end - begin - 2));
    for (std::string file; files >> file; ++named) {
      std::erase_if(file, [](char c) { return c == '`' || c == ','; });
      EXPECT_TRUE(fs::exists(fs::path(SWIFTLET_SOURCE_DIR) / file)) << file;
    }
  }
  EXPECT_GT(named, 50);
}

}  // namespace
}  // namespace swiftlet::commands
