// A topological map as a file: what is written is read back, and what is wrong has a message.
#include "common/topological_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/config.hpp"

namespace swiftlet::common {
namespace {

using testing::Contains;
using testing::ElementsAre;

TopologicalMap read(const std::string& yaml) {
  TopologicalMap map;
  config::YamlReader::fromText(yaml, "places.yaml").read(map);
  return map;
}

std::vector<std::string> namesOfProblems(const std::string& yaml) {
  std::vector<std::string> names;
  try {
    (void)read(yaml);
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) names.emplace_back(problem.message.name());
  }
  return names;
}

double coordinate() { return 1e-3 * *rc::gen::inRange(-2'000'000, 2'000'000); }

RC_GTEST_PROP(TopologicalMap, IsReadBackAsItWasWritten, ()) {
  TopologicalMap map;
  map.frame = *rc::gen::element(PlacesFrame::kMap, PlacesFrame::kGiven);
  const int places = *rc::gen::inRange(0, 4), passages = *rc::gen::inRange(0, 4), zones = *rc::gen::inRange(0, 3);
  for (int i = 0; i < places; ++i)
    map.places.push_back({"place_" + std::to_string(i), *rc::gen::element<std::string>("", "pad", "a: \"b\"\n#"),
                          coordinate(), coordinate(), coordinate(), 12.5, 0.031});
  for (int i = 0; i < passages; ++i)
    map.passages.push_back({"window_" + std::to_string(i), "window", coordinate(), coordinate(), 1.2, -90.0, 0.9, 1.1,
                            0.02, *rc::gen::element(Passage::kNone, Passage::kOpen, Passage::kClosed)});
  for (int i = 0; i < zones; ++i) {
    const double x = coordinate(), y = coordinate();
    map.danger_zones.push_back({"zone_" + std::to_string(i), {x, y, x + 1.0, y, x + 1.0, y + 2.0}});
  }
  const std::string yaml = toYaml(map);
  const TopologicalMap again = read(yaml);
  RC_ASSERT(toYaml(again) == yaml);
  RC_ASSERT(again.names() == map.names());
  for (std::size_t i = 0; i < map.passages.size(); ++i) RC_ASSERT(again.passages[i].state == map.passages[i].state);
  for (std::size_t i = 0; i < map.places.size(); ++i) RC_ASSERT(again.places[i].x_m == map.places[i].x_m);
}

TEST(TopologicalMap, IsWrittenByHandToo) {
  const TopologicalMap map = read(
      "places:\n  - {name: kitchen, x_m: 3.5, y_m: -1}\n"
      "passages:\n  - {name: north, what: window, x_m: 2, y_m: 0, z_m: 1.2, width_m: 1, state: closed}\n"
      "danger_zones:\n  - {name: stairs, corners_m: [0, 0, 1, 0, 1, 1]}\n");
  EXPECT_THAT(map.names(), ElementsAre("kitchen", "north", "stairs"));
  EXPECT_EQ(map.passages[0].state, Passage::kClosed);
}

TEST(TopologicalMap, SaysWhatIsWrong) {
  EXPECT_THAT(namesOfProblems("places:\n  - {name: the kitchen, x_m: 1}\n"), Contains("places.name"));
  EXPECT_THAT(namesOfProblems("places:\n  - {x_m: 1}\n"), Contains("places.name"));
  EXPECT_THAT(namesOfProblems("places:\n  - {name: a}\npassages:\n  - {name: a}\n"), Contains("config.name-twice"));
  EXPECT_THAT(namesOfProblems("danger_zones:\n  - {name: a, corners_m: [0, 0, 1]}\n"), Contains("places.odd-corners"));
  EXPECT_THAT(namesOfProblems("danger_zones:\n  - {name: a, corners_m: [0, 0, 1, 1]}\n"), Contains("places.polygon"));
  EXPECT_FALSE(namesOfProblems("places:\n  - {name: a, x_m: .nan}\n").empty());
  EXPECT_FALSE(namesOfProblems("place:\n  - {name: a}\n").empty());
  EXPECT_THROW((void)readTopologicalMap("no/such/places.yaml"), InputError);
}

}  // namespace
}  // namespace swiftlet::common
