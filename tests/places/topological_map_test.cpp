#include "flight/topological_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/config.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::flight {
namespace {

using common::Passage;
using common::RecognizedObject;
using common::TopologicalMap;
using testing::ElementsAre;

RecognizedObject object(int id, const std::string& what, const Eigen::Vector3d& place, Passage passage,
                        bool confirmed = true) {
  RecognizedObject one;
  one.id = id;
  one.what = what;
  one.T_map_object = {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())), place};
  one.covariance_m2 = 3e-4 * Eigen::Matrix3d::Identity();
  one.size_m = {0.9, 1.1};
  one.passage = passage;
  one.confirmed = confirmed;
  return one;
}

/// A window, a closed door, a mirror, a landing pad, a candidate; a zone; and a mission that flies to a kitchen.
test::Layers seen() {
  test::Layers layers;
  layers.objects = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{
      {object(1, "window", {2.0, 0.5, 1.2}, Passage::kOpen), object(2, "door", {-3.0, 0.0, 1.0}, Passage::kClosed),
       object(3, "mirror", {0.0, 4.0, 1.2}, Passage::kNone), object(4, "landing pad", {1.0, 1.0, 0.0}, Passage::kNone),
       object(5, "window", {9.0, 9.0, 1.0}, Passage::kNone, false)}});
  layers.map.keep_out = std::make_shared<const std::vector<common::Polygon>>(
      std::vector<common::Polygon>{{{{4.0, 4.0}, {5.0, 4.0}, {5.0, 5.0}}}});
  layers.mission.status.tree = {{0, -1, "Main", "RUNNING", "Sequence"},
                                {1, 0, "kitchen", "RUNNING", "MoveToGoal", {{"goal", "", "3;-1.5"}}},
                                {2, 0, "MoveToGoal", "IDLE", "MoveToGoal", {{"goal", "", "7;7"}}},
                                {3, 0, "hall", "IDLE", "MoveToGoal", {{"goal", "place", "8;8"}}}};
  return layers;
}

TEST(TopologicalMapOfAFlight, HasWhatItHasFoundAndWhatItsMissionNames) {
  const TopologicalMap map = topologicalMapOf(seen().world(), nullptr);
  EXPECT_EQ(map.frame, common::PlacesFrame::kMap);
  EXPECT_THAT(map.names(), ElementsAre("landing_pad_4", "home", "kitchen", "window_1", "door_2", "keep_out_1"));
  EXPECT_EQ(map.places[0].what, "landing pad");
  EXPECT_EQ(map.places[2].x_m, 3.0);
  EXPECT_EQ(map.places[2].y_m, -1.5);
  EXPECT_EQ(map.passages[0].state, Passage::kOpen);
  EXPECT_EQ(map.passages[0].width_m, 0.9);
  EXPECT_NEAR(std::abs(map.passages[0].normal_deg), 180.0, 0.01);
  EXPECT_NEAR(map.passages[0].sigma_m, 0.03, 1e-9);
  EXPECT_EQ(map.passages[1].state, Passage::kClosed);
  EXPECT_THAT(map.danger_zones[0].corners_m, ElementsAre(4.0, 4.0, 5.0, 4.0, 5.0, 5.0));
}

TEST(TopologicalMapOfAFlight, IsReadBackAndKeepsItsNames) {
  const TopologicalMap first = topologicalMapOf(seen().world(), nullptr);
  TopologicalMap read;
  common::config::YamlReader::fromText(toYaml(first), "topological_map.yaml").read(read);
  read.passages[0].name = "north_window";
  read.danger_zones[0].name = "stairs";
  // The next flight sees the window under another number, 10 cm aside, and the door open.
  test::Layers next = seen();
  common::ObjectsLayer objects = *next.objects;
  objects.objects[0].id = 7;
  objects.objects[0].T_map_object.position_m.y() += 0.1;
  objects.objects[1].passage = Passage::kOpen;
  next.objects = std::make_shared<const common::ObjectsLayer>(objects);
  const TopologicalMap second = topologicalMapOf(next.world(), &read);
  EXPECT_THAT(second.names(),
              testing::UnorderedElementsAre("landing_pad_4", "home", "kitchen", "north_window", "door_2", "stairs"));
  for (const common::MapPassage& passage : second.passages) EXPECT_EQ(passage.state, Passage::kOpen) << passage.name;
}

TEST(TopologicalMapOfAFlight, IsInTheFrameOfTheGivenMapWhileLocalizedInIt) {
  test::Layers layers = seen();
  layers.map.localization.emplace();
  TopologicalMap given;
  given.places.push_back({.name = "office", .x_m = 20.0});
  EXPECT_THAT(topologicalMapOf(layers.world(), &given).names(), testing::Not(testing::Contains("office")))
      << "its place in `map` is not known";
  layers.map.T_map_given = common::Pose2{-10.0, 0.0, 0.0};
  const TopologicalMap map = topologicalMapOf(layers.world(), &given);
  EXPECT_EQ(map.frame, common::PlacesFrame::kGiven);
  EXPECT_THAT(map.names(), testing::Contains("office"));
  EXPECT_NEAR(map.passages[0].x_m, 12.0, 1e-9);
}

}  // namespace
}  // namespace swiftlet::flight
