// Every input that cannot be used is refused with exit code 2 and a message that names place and cause; nothing is
// written.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

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

class BadInput : public RefusalsBeforeWriting {
 protected:
  std::string hop() const { return write("hop.xml", missionWith(kHop)); }

  /// `--out` and `--time-limit` have short values unless they are among `more`.
  ProgramEnd fly(std::vector<std::string> more, const ProgramOptions& options = {}) const {
    std::vector<std::string> arguments = {"fly", "--speed", "max"};
    for (const auto& [option, value] : {std::pair{"--time-limit", std::string("5")}, {"--out", path("run")}})
      if (std::find(more.begin(), more.end(), option) == more.end()) arguments.insert(arguments.end(), {option, value});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runSwiftlet(arguments, options);
  }

  /// A wrong mission is refused by `check` and by `fly` in the same words.
  void expectMissionRefused(const std::string& leaves, const std::string& pattern) const {
    const std::string mission = write("broken.xml", missionWith(leaves));
    expectRefused(runSwiftlet({"check", mission}), pattern);
    expectRefused(fly({"--headless", mission}), pattern);
  }
  void expectWorldRefused(const std::string& world, const std::string& pattern) const {
    expectRefused(fly({"--headless", hop(), "--world", write("broken.sdf", world)}), pattern);
  }
};

TEST_F(BadInput, AMissionThatIsNotXmlIsRefused) {
  const std::string mission =
      write("broken.xml", "<root BTCPP_format=\"4\">\n  <BehaviorTree ID=\"Main\">\n    <Land/>\n</root>\n");
  expectRefused(runSwiftlet({"check", mission}), "broken\\.xml:4:[0-9]+: ");
  expectRefused(fly({"--headless", mission}), "broken\\.xml:4:[0-9]+: ");
}

TEST_F(BadInput, AnEmptyMissionIsRefused) {
  expectRefused(runSwiftlet({"check", write("broken.xml", "")}), "broken\\.xml:1");
}

TEST_F(BadInput, AMissingMissionIsRefused) {
  expectRefused(runSwiftlet({"check", path("none.xml")}), "none\\.xml: ");
  expectRefused(fly({"--headless", path("none.xml")}), "none\\.xml: ");
}

TEST_F(BadInput, OneSensorMakesThe3DMap) {
  const std::string both =
      write("both.yaml", "vehicle: cobra\nlaser: utm_30lx\nrgbd_camera: xtion\nvertical_laser: utm_30lx_upright\n");
  expectRefused(fly({"--headless", hop(), "--system", both}),
                "both\\.yaml:4:17: vertical_laser: one sensor makes the 3D map.*leave out one");
  const std::string mirrored = write("mirrored.yaml", "vehicle: cobra\nlaser: utm_30lx\nvertical_laser: utm_30lx\n");
  expectRefused(fly({"--headless", hop(), "--system", mirrored}),
                "mirrored\\.yaml:3:17: vertical_laser: utm_30lx has a mirror.*utm_30lx_upright");
}

TEST_F(BadInput, AMisspeltMissionNameGetsASuggestion) {
  expectRefused(fly({"--headless", "missions/explore_and_retrun.xml"}),
                "did you mean `missions/explore_and_return\\.xml`");
}

TEST_F(BadInput, AnUnknownNodeIsRefused) {
  expectMissionRefused("      <Explor clearance_m=\"0.1\"/>\n", "broken\\.xml:4:7: .*Explor.*did you mean `Explore`");
}

TEST_F(BadInput, AnUnknownPortIsRefused) {
  expectMissionRefused("      <TakeOff hight_m=\"1.0\"/>\n",
                       "broken\\.xml:4:[0-9]+: .*hight_m.*did you mean `height_m`");
}

TEST_F(BadInput, APortWithoutItsUnitIsRefused) {
  expectMissionRefused("      <TakeOff height=\"1.0\"/>\n", "broken\\.xml:4:[0-9]+: .*height.*did you mean `height_m`");
}

TEST_F(BadInput, APortOfTheWrongTypeIsRefused) {
  expectMissionRefused("      <TakeOff height_m=\"high\"/>\n", "broken\\.xml:4:[0-9]+: .*height_m.*high");
}

TEST_F(BadInput, AGoalThatIsNotAPointIsRefused) {
  expectMissionRefused("      <MoveToGoal goal=\"3.0;north\"/>\n", "broken\\.xml:4:[0-9]+: .*goal.*3\\.0;north");
}

TEST_F(BadInput, AClearanceBelowTheReactiveMarginIsRefused) {
  expectMissionRefused("      <TakeOff/>\n      <Explore clearance_m=\"0.04\"/>\n      <Land/>\n",
                       "broken\\.xml:5:16: Explore\\.clearance_m: 0\\.04 m cannot be flown with this system: "
                       "margin_m: 0\\.05 m forbids the clearance");
}

TEST_F(BadInput, BoundsThatAreNotARectangleAreRefused) {
  expectMissionRefused("      <TakeOff/>\n      <Explore bounds=\"3;0;-2;1\"/>\n      <Land/>\n",
                       "broken\\.xml:5:16: Explore\\.bounds: `3;0;-2;1` is not a rectangle");
}

TEST_F(BadInput, AMissionThatNeverTakesOffIsRefused) {
  expectMissionRefused("      <Hold/>\n", "broken\\.xml:3:5: Main: the mission never takes off");
}

TEST_F(BadInput, AMissionThatTheSystemCannotFlyIsRefused) {
  write("low_cobra.yaml", "max_height_m: 0.8\n");
  const std::string system = write("low.yaml", "vehicle: low_cobra.yaml\n");
  const std::string says = "hop\\.xml:4:16: TakeOff\\.height_m: 1 m is above the greatest height, 0\\.8 m";
  expectRefused(runSwiftlet({"check", hop(), "--system", system}), says);
  expectRefused(fly({"--headless", hop(), "--system", system}), says);
  EXPECT_EQ(runSwiftlet({"check", hop()}).exit_code, 0) << "the default vehicle flies it";
  const std::string trial =
      write("high.yaml", "mission: " + hop() + "\nsystem: " + system + "\nscenario: {world: worlds/unb_case1.sdf}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("run")}), says);
}

TEST_F(BadInput, AProfileWithContradictoryDistancesIsRefused) {
  const std::string system = write("shy.yaml", "autonomy:\n  reactive:\n    avoidance:\n      margin_m: 0.2\n");
  expectRefused(runSwiftlet({"check", hop(), "--system", system}),
                "shy\\.yaml:4:17: autonomy\\.reactive\\.avoidance\\.margin_m: 0\\.20 m forbids the clearance");
}

TEST_F(BadInput, AllMistakesAreReportedTogether) {
  const std::string mission =
      write("broken.xml", missionWith("      <Explor/>\n      <TakeOff height_m=\"high\"/>\n      <Lend/>\n"));
  const ProgramEnd end = runSwiftlet({"check", mission});
  for (const std::string line : {":4:", ":5:", ":6:"}) EXPECT_THAT(end.err, HasSubstr("broken.xml" + line));

  const auto json = nlohmann::json::parse(runSwiftlet({"check", "--json", mission}).out);
  EXPECT_EQ(json.at("problems").size(), 3u) << json.dump(2);
  EXPECT_EQ(json.at("problems")[1].at("line"), 5);
}

TEST_F(BadInput, AMissingWorldIsRefused) {
  expectRefused(fly({"--headless", hop(), "--world", "worlds/none.sdf"}), "worlds/none\\.sdf: no such file");
}

TEST_F(BadInput, AWorldThatIsNotXmlIsRefused) {
  expectWorldRefused("<sdf version=\"1.9\">\n<world>\n", "broken\\.sdf:[0-9]+");
}

TEST_F(BadInput, AWorldWithAnInvalidShapeIsRefused) {
  expectWorldRefused(worldWith(floorBox() + box("wall", "2 0 1 0 0 0", "1 -1 wide")), "broken\\.sdf:[0-9]+");
}

TEST_F(BadInput, AWorldWithoutAFloorIsRefused) {
  expectWorldRefused(worldWith(box("wall", "3 0 1 0 0 0", "0.2 4 2")), "broken\\.sdf.*floor");
}

TEST_F(BadInput, AWorldThatIsAPipeIsRefused) {
  ASSERT_EQ(mkfifo(path("pipe.sdf").c_str(), 0600), 0);
  expectRefused(fly({"--headless", hop(), "--world", path("pipe.sdf")}), "pipe\\.sdf: is a pipe");
}

TEST_F(BadInput, WorldsThatIncludeEachOtherAreRefused) {
  expectWorldRefused(worldWith("<include><uri>broken.sdf</uri></include>\n"), "broken\\.sdf:4:[0-9]+: .*each other");
}

TEST_F(BadInput, AStartInsideAWallIsRefused) {
  expectWorldRefused(worldWith(floorBox() + box("pillar", "0.1 0 1 0 0 0", "0.3 0.3 2")),
                     "broken\\.sdf.*start.*`?pillar");
}

TEST_F(BadInput, AnUnknownConfigKeyIsRefused) {
  const std::string system = write("mine.yaml", "vehicle: cobra\nlasser: utm_30lx\n");
  expectRefused(fly({"--headless", hop(), "--system", system}), "mine\\.yaml:2:1: .*lasser.*did you mean `laser`");
  expectRefused(runSwiftlet({"config", "--system", system}), "mine\\.yaml:2:1: ");
}

TEST_F(BadInput, AConfigThatIsNotYamlIsRefused) {
  const std::string system = write("mine.yaml", "vehicle: cobra\n  laser: [utm\n");
  expectRefused(fly({"--headless", hop(), "--system", system}), "mine\\.yaml:2");
}

TEST_F(BadInput, AnUnknownSystemIsRefused) {
  expectRefused(fly({"--headless", hop(), "--system", "swiftled"}), "did you mean `(config/systems/)?swiftlet");
}

TEST_F(BadInput, AProfileThatNamesNothingOrWhatIsUnknownIsRefused) {
  for (const std::string text : {"", "# Nothing but this.\n"})
    expectRefused(fly({"--headless", hop(), "--system", write("mine.yaml", text)}),
                  "mine\\.yaml: names no setting, so it is no profile, the least one is `based_on: swiftlet`");
  const std::string system = write("mine.yaml", "vehicle: cobra\nlaser: utm\n");
  expectRefused(fly({"--headless", hop(), "--system", system}),
                "mine\\.yaml:2:8: laser: utm: no such file.*config/sensors has firefly_stereo, firefly_stereo_ahead, "
                "realsense_d455, "
                "sick_lms_291, urg_04lx, utm_30lx");
}

TEST_F(BadInput, DataSheetsAreFoundBesideTheProfileThatNamesThem) {
  const std::string system = write("mine.yaml", "vehicle: nimble.yaml\nlaser: utm_30lx\n");
  expectRefused(runSwiftlet({"config", "--system", system}),
                "mine\\.yaml:[0-9]+:[0-9]+: vehicle: nimble\\.yaml: no such file");
  (void)write("nimble.yaml", "name: nimble\nmass_kg: 1.2\n");
  const ProgramEnd found = runSwiftlet({"config", "--system", system});
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_NE(found.out.find("mass_kg: 1.2"), std::string::npos);
}

TEST_F(BadInput, APortInUseIsRefused) {
  const int socket_in_use = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(socket_in_use, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(socket_in_use, 1), 0);
  socklen_t size = sizeof address;
  getsockname(socket_in_use, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string port = std::to_string(ntohs(address.sin_port));

  expectRefused(fly({hop(), "--world", write("room.sdf", worldWith(room())), "--port", port}), port + ".*in use");
  close(socket_in_use);
}

TEST_F(BadInput, AnInvalidListenAddressIsRefused) {
  expectRefused(fly({hop(), "--world", write("room.sdf", worldWith(room())), "--port", "0", "--listen", "300.1.1.1"}),
                "300\\.1\\.1\\.1");
}

TEST_F(BadInput, AnInvalidPublicUrlIsRefusedWithWhatToWrite) {
  const std::vector<std::string> with{hop(), "--port", "0", "--public-url"};
  const auto flyWith = [&](std::vector<std::string> arguments, const std::string& url) {
    arguments.push_back(url);
    return fly(arguments);
  };
  expectRefused(flyWith(with, "drone.local:8080"), "--public-url: .*write http://drone.local:8080 or https://");
  expectRefused(flyWith(with, "https://field.example/?token=x"), "--public-url: .*write https://field.example/");
  expectRefused(flyWith({hop(), "--headless", "--public-url"}, "field.example"), "--public-url: ");
}

TEST_F(BadInput, AFileAsOutputFolderIsRefused) {
  write("taken", "mine");
  const ProgramEnd end =
      fly({"--headless", hop(), "--world", write("room.sdf", worldWith(room())), "--out", path("taken")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("taken"));
  EXPECT_EQ(readText(path("taken")), "mine");
}

TEST_F(BadInput, AForeignOutputFolderIsRefused) {
  fs::create_directories(path("thesis"));
  write("thesis/chapter1.tex", "years of work");
  const ProgramEnd end =
      fly({"--headless", hop(), "--world", write("room.sdf", worldWith(room())), "--out", path("thesis")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("thesis"));
  EXPECT_EQ(readText(path("thesis/chapter1.tex")), "years of work");
}

TEST_F(BadInput, InvalidTextInNamesStillGivesValidJson) {
  const ProgramEnd end = runSwiftlet({"check", "--json", write("odd\xff.xml", "<root>")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_TRUE(nlohmann::json::accept(end.out)) << describe(end);
}

// The files of the flight matter; its lines on the terminal do not.
TEST_F(BadInput, AClosedTerminalDoesNotEndAFlight) {
  ProgramOptions options;
  options.hang_up_after_bytes = 1;
  const ProgramEnd end =
      fly({"--headless", hop(), "--world", write("room.sdf", worldWith(room())), "--time-limit", "60"}, options);
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(nlohmann::json::parse(readText(path("run/mission.json"))).at("outcome"), "done");
}

TEST_F(BadInput, AClosedTerminalDoesNotEndATrial) {
  const std::string trial =
      write("t.yaml", "mission: " + hop() + "\nscenario: {world: " + write("room.sdf", worldWith(room())) +
                          "}\ntime_limit_s: 60\n");
  ProgramOptions options;
  options.hang_up_after_bytes = 1;
  const ProgramEnd end = runSwiftlet({"trial", trial, "--repeat", "2", "--out", path("run")}, options);
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_EQ(nlohmann::json::parse(readText(path("run/results.json"))).at("trials")[0].at("passed"), 2);
}

class FullDisk : public BadInput, public testing::WithParamInterface<std::size_t> {};

// At whatever file the disk becomes full, the message names that file, and none is left half written. A flight that has
// begun is flown to its end.
TEST_P(FullDisk, IsReportedWithTheFileAndEndsNoFlight) {
  ProgramOptions options;
  options.largest_file_bytes = GetParam();
  const ProgramEnd end =
      fly({"--headless", hop(), "--world", write("room.sdf", worldWith(room())), "--time-limit", "60"}, options);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, ContainsRegex("run/[a-z]+\\.[a-z]+: .*(too large|No space)"));
  const bool began = GetParam() > 20'000;
  EXPECT_EQ(end.out.find("the run is no longer recorded; the flight goes on") != std::string::npos, began);
  EXPECT_EQ(end.out.find("\ndone after") != std::string::npos, began) << describe(end);
  for (const auto& entry : fs::directory_iterator(path("run"))) {
    const std::string name = entry.path().filename().string(), text = readText(entry.path());
    SCOPED_TRACE(name);
    EXPECT_THAT(
        name, testing::AnyOf("mission.json", "report.html", "events.jsonl", "trajectory.tum", "config.yaml", "map.pgm",
                             "map.yaml", "map.png", "ground_truth.tum", "nature.yaml", "topological_map.yaml"))
        << "was left behind";
    if (name == "mission.json") {
      EXPECT_TRUE(nlohmann::json::accept(text));
    } else if (name == "report.html") {
      EXPECT_THAT(text, HasSubstr("</html>"));
    } else if (name != "map.pgm" && name != "map.png") {
      EXPECT_TRUE(text.empty() || text.ends_with("\n"))
          << "half a line: " << text.substr(text.size() - std::min<std::size_t>(text.size(), 80));
    }
  }
}

// The configuration is written first and has about 20 kB; a report with pictures has more than 90.
INSTANTIATE_TEST_SUITE_P(AtTheStartAndInFlight, FullDisk, testing::Values(8'192, 60'000));

TEST_F(BadInput, AnOutputFolderThatCannotBeCreatedIsRefused) {
  const ProgramEnd end =
      fly({"--headless", hop(), "--world", write("room.sdf", worldWith(room())), "--out", "/dev/full/run"});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("/dev/full"));
}

struct Usage {
  std::string name;
  std::vector<std::string> arguments;
  std::string says;
};
void PrintTo(const Usage& usage, std::ostream* stream) { *stream << usage.name; }
class WrongUsage : public testing::TestWithParam<Usage> {};

TEST_P(WrongUsage, IsRefused) {
  const ProgramEnd end = runSwiftlet(GetParam().arguments);
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr(GetParam().says)) << describe(end);
}

INSTANTIATE_TEST_SUITE_P(
    Commands, WrongUsage,
    testing::Values(
        Usage{"nothing", {}, "subcommand"}, Usage{"unknown_command", {"swim"}, "swim"},
        Usage{"no_mission", {"fly", "--headless"}, "mission"},
        Usage{"unknown_option", {"fly", "missions/explore_and_return.xml", "--sped", "2"}, "--sped"},
        Usage{"bad_speed", {"fly", "missions/explore_and_return.xml", "--headless", "--speed", "fast"}, "fast"},
        Usage{"negative_speed", {"fly", "missions/explore_and_return.xml", "--headless", "--speed", "-1"}, "-1"},
        Usage{"bad_port", {"fly", "missions/explore_and_return.xml", "--port", "70000"}, "70000"},
        Usage{"endless_flight", {"fly", "missions/explore_and_return.xml", "--time-limit", "nan"}, "`nan`"},
        Usage{"huge_time", {"fly", "missions/explore_and_return.xml", "--time-limit", "1e400"}, "0.01 to 1000000"},
        Usage{"negative_seed", {"fly", "missions/explore_and_return.xml", "--seed", "-1"}, "`-1`"},
        Usage{"seed_out_of_range", {"trial", "trials", "--seed", "2147483647"}, "2147483647"},
        Usage{"seeds_out_of_range",
              {"trial", "trials/unb_case1_calm.yaml", "--seed", "1000000000", "--repeat", "2"},
              "--seed: 2 flights from seed 1000000000 on would end with seed 1000000001"},
        Usage{"only_without_envelope", {"trial", "trials", "--only", "wind"}, "--only: goes only with --envelope"},
        Usage{"quantities_without_envelope",
              {"trial", "trials", "--quantities", "q.yaml"},
              "--quantities: goes only with --envelope"},
        Usage{"write_without_envelope", {"trial", "trials", "--write", "p.md"}, "--write: goes only with --envelope"},
        Usage{"empty_nature", {"fly", "missions/explore_and_return.xml", "--nature", ""}, "--nature"},
        Usage{"empty_system", {"trial", "trials", "--system", ""}, "--system"},
        Usage{"no_repeat", {"trial", "trials", "--repeat", "0"}, "1 to 10000"},
        Usage{"no_jobs", {"trial", "trials", "--jobs", "0"}, "1 to 64"},
        Usage{"trials_into_a_file", {"trial", "trials", "--out", "/dev/null"}, "/dev/null: --out"},
        Usage{"bad_seed", {"fly", "missions/explore_and_return.xml", "--seed", "lucky"}, "lucky"},
        Usage{"missing_trial", {"trial", "trials/none.yaml"}, "trials/none.yaml"},
        Usage{"check_nothing", {"check"}, "missions"}),
    [](const auto& usage) { return usage.param.name; });

}  // namespace
}  // namespace swiftlet::commands
