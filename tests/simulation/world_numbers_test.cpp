// Numbers of a world that are written in another way than SDF's, and starts that leave no room.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "common/error.hpp"
#include "common/image.hpp"
#include "common/png_encoder.hpp"
#include "fixtures.hpp"
#include "sdf_texts.hpp"
#include "simulation/sdf_text.hpp"
#include "simulation/uri_resolver.hpp"
#include "simulation/variation.hpp"
#include "simulation/world_model.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::problemsOf;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::IsEmpty;

class WorldNumbers : public ::testing::Test {
 protected:
  WorldModel loadModels(const std::string& models) {
    return loadWorld(
        folder_.write("world.sdf", "<sdf version='1.9'>\n<world name='w'>\n" + models + "</world></sdf>\n"));
  }
  /// What refuses the world, or the start in it.
  std::vector<common::Problem> refusalOf(const std::string& models, const StartConfig& start = {},
                                         double hull_diameter_m = common::VehicleConfig().hull_diameter_m) {
    return problemsOf([&] {
      Scenario scenario;
      scenario.start = start;
      scenario.vehicle.hull_diameter_m = hull_diameter_m;
      realize(loadModels(models), scenario);
    });
  }

  TemporaryFolder folder_{"swiftlet_world_numbers"};
};

const std::string kWideFloor = model("floor", "<box><size>20 20 0.1</size></box>", "0 0 -0.05 0 0 0");

StartConfig startAt(double x_m, double y_m) { return {false, x_m, y_m, 0.0, 0.0}; }

/// The start that a hint proposes.
StartConfig proposedIn(const std::vector<common::Problem>& problems) {
  StartConfig start = startAt(0.0, 0.0);
  const std::string text = problems.empty() ? "" : problems.front().hint;
  const std::size_t at = text.find("--start \"");
  if (at != std::string::npos) std::sscanf(text.c_str() + at, "--start \"%lf;%lf;", &start.x_m, &start.y_m);
  return start;
}

TEST_F(WorldNumbers, ThatSdfDoesNotHaveAreRefusedWithWhatToWrite) {
  const auto box = [](const std::string& size) { return "<box><size>" + size + "</size></box>"; };
  for (const auto& [geometry, wanted] :
       {std::pair{box("1,5 2 3"), "write `1.5 2 3`"},
        {box("1, 2, 3"), "write `1 2 3`"},
        {box("1;2;3"), "write `1 2 3`"},
        {box("1 2\u200B 3"), "write `1 2 3`"},
        {box("1\u00A02 3"), "write `1 2 3`"},
        {box("1\u00A02 3"), "it has a no-break space (U+00A0), write `1 2 3`"},
        {box("1 2\u200B 3"), "it has a zero-width space (U+200B), write `1 2 3`"},
        {box("1&#160;2 3"), "write `1 2 3`"},
        {box("wide\u200B"), "it has a zero-width space (U+200B): write nothing there"},
        {box("1m 2 m 3m"), "write `1 2 3`"},
        {box("1 2 3 4"), "`1 2 3 4` has 4"},
        {box("wide"), "`wide`"},
        {std::string("<sphere><radius>0,5</radius></sphere>"), "write `0.5`"},
        {std::string("<cylinder><radius>1</radius><length>2,5 m</length></cylinder>"), "write `2.5`"},
        {std::string(
             "<polyline><point>0 0</point><point>1,5 0</point><point>1 1</point><height>2,5</height></polyline>"),
         "write `2.5`"}})
    EXPECT_THAT(refusalOf(kWideFloor + model("thing", geometry)), HasProblem(kAnyName, "world.sdf:4", wanted))
        << geometry;
  EXPECT_THAT(refusalOf(kWideFloor + model("thing", kBox, "4 \u22122.5 0 0 0 0")),
              HasProblem("sdf.no-number", "pose", "`4 -2.5 0 0 0 0`"));
  EXPECT_THAT(refusalOf("<frame name='start'><pose>1,5 1,5 0 0 0 0</pose></frame>" + kWideFloor),
              HasProblem("sdf.no-number", "world.sdf:3", "`1.5 1.5 0 0 0 0`"));
}

TEST_F(WorldNumbers, OfSdfAndOfPluginsAreTaken) {
  const std::string plugin = "<plugin name='p' filename='f'><model><pose>1,5</pose></model></plugin>";
  EXPECT_THAT(
      refusalOf(kWideFloor + plugin + model("thing", "<box><size>+1 .5\n 1e0</size></box>", "4 2. 0 0 0 -1e-2")),
      IsEmpty());
  EXPECT_THAT(refusalOf(kWideFloor + model("thing", "<box><size>&#49;&#x20;&#50;&#x9;3</size></box>", "4 2 0 0 0 0")),
              IsEmpty());
}

TEST_F(WorldNumbers, AStartUnderATableIsRefusedForOneThatWillDo) {
  const std::string models = kWideFloor + model("table", "<box><size>1.6 0.8 0.04</size></box>", "0 0 0.75 0 0 0");
  const auto problems = refusalOf(models, startAt(0.0, 0.0));
  EXPECT_THAT(problems, HasProblem("start.no-room", "", "`table/l`"));
  EXPECT_THAT(refusalOf(models, proposedIn(problems)), IsEmpty());
}

/// The ground beside the hull is higher than below it, by 3 cm below the wide hull of a Pelican; a post is not ground.
TEST_F(WorldNumbers, AStartOnASlopeIsTakenIfNothingStandsOnIt) {
  constexpr double kPelican_m = 0.7;
  const std::string slope = model("slope", "<box><size>20 20 1</size></box>", "0 0 -0.5019 0 -0.0873 0");
  const std::string post = model("post", "<box><size>0.05 0.05 0.6</size></box>", "0.37 0 0.2 0 0 0");
  for (const double yaw_deg : {0.0, 20.0, 45.0}) {
    StartConfig start = startAt(0.0, 0.0);
    start.yaw_deg = yaw_deg;
    EXPECT_THAT(refusalOf(slope, start), IsEmpty()) << yaw_deg;
    EXPECT_THAT(refusalOf(slope, start, kPelican_m), IsEmpty()) << yaw_deg;
    EXPECT_THAT(refusalOf(slope + post, start, kPelican_m), HasProblem("start.in-obstacle", "", "`post/l`")) << yaw_deg;
  }
}

TEST_F(WorldNumbers, AStartInTheWallOfARoomIsMovedIntoTheRoom) {
  const std::string models = kWideFloor + model("south", "<box><size>8.1 0.1 2.5</size></box>", "4 0 1.25 0 0 0") +
                             model("north", "<box><size>8.1 0.1 2.5</size></box>", "4 5 1.25 0 0 0") +
                             model("west", "<box><size>0.1 5.1 2.5</size></box>", "0 2.5 1.25 0 0 0") +
                             model("east", "<box><size>0.1 5.1 2.5</size></box>", "8 2.5 1.25 0 0 0");
  for (const auto& [x_m, y_m] : {std::pair{0.0, 0.0}, {4.0, 0.0}, {8.0, 2.5}}) {
    const StartConfig start = proposedIn(refusalOf(models, startAt(x_m, y_m)));
    EXPECT_TRUE(start.x_m > 0.3 && start.x_m < 7.7 && start.y_m > 0.3 && start.y_m < 4.7)
        << start.x_m << " " << start.y_m;
  }
}

TEST_F(WorldNumbers, AStartBeneathATerrainIsRefused) {
  const common::Image white{3, 3, std::vector<std::uint8_t>(27, 255)};
  const auto bytes = common::encodePng(white);
  folder_.write("hill.png", std::string(bytes.begin(), bytes.end()));
  EXPECT_THAT(refusalOf(kWideFloor + model("hill", "<heightmap><uri>hill.png</uri><size>4 4 2</size></heightmap>"),
                        startAt(0.5, 0.5)),
              HasProblem("start.beneath-terrain", "", "`hill/l`"));
}

TEST_F(WorldNumbers, ASecondStateIsNamed) {
  const std::string state = "<state world_name='w'><model name='floor'><pose>0 0 0 0 0 0</pose></model></state>\n";
  EXPECT_THAT(loadModels(kWideFloor + state + state).warnings, HasProblem("state.further", "state"));
}

TEST(SdfLines, EndInEveryWayThatSystemsHave) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "a" + end + "b" + end + "cde";
    const common::SourceLocation at = locationIn("f", text, text.size() - 1);
    EXPECT_EQ(at.line, 3);
    EXPECT_EQ(at.column, 3);
  }
}

TEST(SdfLines, AFuelModelOfAnotherVersionIsNamedWithTheOnesThatAreThere) {
  TemporaryFolder folder("swiftlet_fuel_versions");
  folder.write("cache/fuel.gazebosim.org/o/models/p/3/model.sdf", "<sdf version='1.9'/>");
  const auto hintOf = [&](const std::string& uri) {
    return UriResolver(folder.path() / "w.sdf", {(folder.path() / "cache").string()}).hintFor(uri, {});
  };
  EXPECT_THAT(hintOf("HTTPS://Fuel.GazeboSim.org/1.0/o/models/p/2"),
              AllOf(HasSubstr("version 3"), HasSubstr("models/p/2\"")));
  EXPECT_THAT(hintOf("https://models.example.org/1.0/o/models/q"),
              AllOf(HasSubstr("from https://models.example.org"), ::testing::Not(HasSubstr("gz fuel"))));
}

}  // namespace
}  // namespace swiftlet::simulation
