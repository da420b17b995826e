// Flights with a given map: one localizes in a map made by another vehicle at another height, and a file that is not a
// map is refused before anything moves.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class FlyWithMap : public test_support::Scratch {};

TEST_F(FlyWithMap, FindsItsPoseWithinFiveMetresInAMapFromAnotherHeight) {
  const ProgramEnd end = runSwiftlet({"trial", "trials/papers/freiburg_localize.yaml", "--system", "swiftlet",
                                      "--repeat", "1", "--seed", "8101", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto trial = nlohmann::json::parse(end.out)["trials"][0];
  const auto localization = trial["flights"][0]["localization"];
  EXPECT_EQ(localization["in_time"], true);
  EXPECT_LT(localization["error_m"], 0.15);
  EXPECT_EQ(localization["wrong_share"], 0.0);
  EXPECT_EQ(trial["localized_flights"], 1.0);
  const std::string run = "out/freiburg_localize-8101/";
  EXPECT_THAT(readText(path(run + "events.jsonl")), HasSubstr("localized at ("));
  const auto mission = nlohmann::json::parse(readText(path(run + "mission.json")));
  EXPECT_EQ(mission["localization"]["state"], "localized");
  EXPECT_FALSE(readText(path(run + "trajectory_given.tum")).empty());
}

std::string missionOf(const std::string& leaves) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Priority><AvoidObstacle/><Hold/>"
         "<Sequence><TakeOff height_m=\"1.0\"/>" +
         leaves + "<Land/></Sequence></Priority></BehaviorTree></root>";
}

/// The hall of unb_case1 with a crate that was not there before.
std::string hallWithCrate() {
  std::string world = readText(SWIFTLET_SOURCE_DIR "/worlds/unb_case1.sdf");
  const std::string box = "<geometry><box><size>0.5 0.5 1.6</size></box></geometry>";
  world.insert(world.rfind("</world>"),
               "<model name=\"crate\"><static>true</static><pose>7.0 3.6 0.8 0 0 0</pose><link name=\"body\">"
               "<collision name=\"box\">" +
                   box + "</collision><visual name=\"box\">" + box + "</visual></link></model>");
  return world;
}

TEST_F(FlyWithMap, TheMapOfOneFlightIsThatOfTheNext) {
  const std::string first = write("first.xml", missionOf("<FollowPath points=\"3.8;0.6 | 4.2;-2.5 | 1.5;-3.2\"/>"));
  const ProgramEnd flown = runSwiftlet({"fly", first, "--headless", "--seed", "11", "--out", path("first")});
  ASSERT_EQ(flown.exit_code, 0) << describe(flown);

  // From another place and heading, to where the first flight landed, by its map.
  write("second.xml", missionOf("<Localize/><MoveToGoal goal=\"1.5;-3.2\"/>"));
  write("hall.sdf", hallWithCrate());
  const std::string trial =
      write("second.yaml", "mission: " + path("second.xml") + "\ncriteria:\n  goal_error_max_m: 0.20\n" +
                               "map: {file: " + path("first/map.yaml") + ", x_m: 2.0, y_m: 6.5}\n" +
                               "scenario:\n  world: " + path("hall.sdf") +
                               "\n  start: {from_world: false, x_m: 6.2, y_m: 5.6, yaw_deg: -120}\n");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--seed", "12", "--json", "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string events = readText(path("out/second-012/events.jsonl"));
  EXPECT_THAT(events, HasSubstr("localized at ("));
  EXPECT_THAT(events, HasSubstr("obstacle that is not in the given map")) << events;
  EXPECT_THAT(events, HasSubstr("in the given map"));
}

/// The mission gives the map itself, before the take-off, and looks for its place again in mid-flight.
TEST_F(FlyWithMap, AMissionLoadsItsMapAndLooksAroundForItsPlace) {
  const ProgramEnd flown =
      runSwiftlet({"fly", write("first.xml", missionOf("<FollowPath points=\"3.8;0.6 | 4.2;-2.5\"/>")), "--headless",
                   "--seed", "13", "--out", path("first")});
  ASSERT_EQ(flown.exit_code, 0) << describe(flown);
  std::string text = missionOf("<Localize/><Relocalize/><MoveToGoal goal=\"3.0;0.5\" tolerance_m=\"0.2\"/>");
  text.insert(text.find("<TakeOff"), "<LoadMap file=\"first/map.yaml\"/>");
  const std::string second = write("second.xml", text);
  const ProgramEnd end = runSwiftlet({"fly", second, "--headless", "--seed", "14", "--out", path("second")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string events = readText(path("second/events.jsonl"));
  EXPECT_THAT(events, HasSubstr("map first/map.yaml is the given one"));
  EXPECT_THAT(events, HasSubstr("localization in the given map starts again"));
  std::size_t found = 0;
  for (std::size_t at = events.find("localized at ("); at != std::string::npos;
       at = events.find("localized at (", at + 1))
    ++found;
  EXPECT_GE(found, 2u) << events;

  const ProgramEnd none =
      runSwiftlet({"check", write("none.xml", missionOf("<LoadMap file=\"none.yaml\"/><Localize/>"))});
  EXPECT_EQ(none.exit_code, 2) << describe(none);
  EXPECT_THAT(none.err, HasSubstr("none.xml:1:"));
  EXPECT_THAT(none.err, HasSubstr("LoadMap.file"));
}

TEST_F(FlyWithMap, CheckWarnsOfWhatIsOddAboutAMapThatAMissionLoads) {
  std::string pixels(400, '\xfe');
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (i % 20 == 0 || i % 20 == 19 || i < 20 || i >= 380) pixels[i] = '\0';
  write("room.pgm", "P5\n20 20\n255\n" + pixels);
  write("room.yaml", "image: /opt/robot/room.pgm\nresolution: 0.05\norigin: [0, 0, 90]\n");
  const ProgramEnd end =
      runSwiftlet({"check", write("load.xml", missionOf("<LoadMap file=\"room.yaml\"/><Localize/>"))});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("room.yaml:1:8: warning: image: `/opt/robot/room.pgm` is not there"));
  EXPECT_THAT(end.err, HasSubstr("room.yaml:3:9: warning: origin: a yaw of 90 rad is more than a whole turn"));
}

TEST_F(FlyWithMap, AMissionThatNeedsAMapIsRefusedWithoutOne) {
  const ProgramEnd end = runSwiftlet({"fly", "missions/find_yourself.xml", "--headless", "--out", path("run")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_NE(end.err.find("find_yourself.xml:10"), std::string::npos) << end.err;
  EXPECT_NE(end.err.find("needs a map of the place"), std::string::npos) << end.err;
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

TEST_F(FlyWithMap, AnInvalidMapIsRefusedBeforeAnythingMoves) {
  const std::string mission = "missions/find_yourself.xml";
  const ProgramEnd none = runSwiftlet({"fly", mission, "--headless", "--map", path("none.yaml"), "--out", path("run")});
  EXPECT_EQ(none.exit_code, 2) << describe(none);
  EXPECT_THAT(none.err, HasSubstr("none.yaml"));
  write("grey.pgm", std::string("P5\n4 4\n255\n") + std::string(16, '\xcd'));
  const std::string grey = write("grey.yaml",
                                 "image: grey.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                 "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const ProgramEnd end = runSwiftlet({"fly", mission, "--headless", "--map", grey, "--out", path("run")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("grey.yaml:1:8: image: the map has no free cells"));
  const std::string coarse = write("coarse.yaml",
                                   "image: grey.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const ProgramEnd too_coarse = runSwiftlet({"fly", mission, "--headless", "--map", coarse, "--out", path("run")});
  EXPECT_EQ(too_coarse.exit_code, 2) << describe(too_coarse);
  EXPECT_THAT(too_coarse.err,
              HasSubstr("coarse.yaml:2:13: resolution: 0.5 m a cell is too coarse: doors close in it, give "
                        "a map of at most 0.2 m a cell"));
  const std::string lacking = write("lacking.yaml", "image: gone.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  const ProgramEnd no_picture = runSwiftlet({"fly", mission, "--headless", "--map", lacking, "--out", path("run")});
  EXPECT_EQ(no_picture.exit_code, 2) << describe(no_picture);
  EXPECT_THAT(no_picture.err, HasSubstr("lacking.yaml:1:8: image: `" + path("gone.pgm") + "`: no such file"));
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

}  // namespace
}  // namespace swiftlet::commands
