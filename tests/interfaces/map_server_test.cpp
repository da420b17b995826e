// Maps that other tools read, and maps of other tools.
#include "interfaces/files/map_server.hpp"

#include <map>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include "support.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::interfaces {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
using testing::HasSubstr;
namespace occupancy = common::occupancy;

/// Three by two cells with one corner at (-2, 3): occupied, unknown, free below; free, free, occupied above.
OccupancyGrid smallGrid() {
  OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  grid.set({-2, 3}, 40);
  grid.set({0, 3}, -20);
  grid.set({-2, 4}, 0);
  grid.set({-1, 4}, -1);
  grid.set({0, 4}, 1);
  return grid;
}

char kind(occupancy::Cell cell) { return occupancy::isUnknown(cell) ? '?' : occupancy::isOccupied(cell) ? '#' : '.'; }

bool sameKinds(const OccupancyGrid& a, const OccupancyGrid& b) {
  bool same = true;
  a.forEachCell([&](CellIndex c, occupancy::Cell value) { same = same && kind(value) == kind(b.at(c)); });
  b.forEachCell([&](CellIndex c, occupancy::Cell value) { same = same && kind(value) == kind(a.at(c)); });
  return same;
}

TEST(MapServer, WritesTheExpectedFiles) {
  EXPECT_EQ(toPgm(smallGrid()), std::string("P5\n# swiftlet 0.05 m/pixel\n3 2\n255\n\xfe\xfe\x00\x00\xcd\xfe", 41));
  EXPECT_EQ(toMapYaml(smallGrid(), "map.pgm"),
            "image: map.pgm\nmode: trinary\nresolution: 0.050000\norigin: [-0.100000, 0.150000, 0.000000]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(MapServer, ReadsBackAMapOfAnyName) {
  const ScratchFolder folder;
  for (const std::string name :
       {"map", "ground floor", "v1.2_a-b", "floor #2", "a: b", "[x]", "{x}", "it's", "''",   "*x",
        "&x",  "!x",           "%x",       "- x",      "\"x",  "  x", "x ",  "büro", "a\\b", "~"}) {
    ASSERT_TRUE(writeMap(folder, name, smallGrid())) << name;
    EXPECT_TRUE(sameKinds(readMap(folder / (name + ".yaml")).grid, smallGrid())) << name;
    std::filesystem::remove(folder / (name + ".pgm"));
    EXPECT_THAT(problemOf([&] { readMap(folder / (name + ".yaml")); }), HasSubstr("no such file")) << name;
  }
  EXPECT_THAT(toMapYaml(smallGrid(), "ground floor.pgm"), HasSubstr("image: ground floor.pgm\n"));
  EXPECT_THAT(toMapYaml(smallGrid(), "it's.pgm"), HasSubstr("image: 'it''s.pgm'\n"));
}

TEST(MapServer, AnEmptyMapIsOneUnknownPixel) {
  const ScratchFolder folder;
  ASSERT_TRUE(writeMap(folder, "map", common::makeOccupancyGrid(0.1)));
  const StoredMap map = readMap(folder / "map.yaml");
  EXPECT_TRUE(knownExtent(map.grid).empty());
  EXPECT_EQ(map.grid.resolution_m(), 0.1);
}

RC_GTEST_PROP(MapServer, ReadsBackWhatItWrote, ()) {
  const ScratchFolder folder;
  OccupancyGrid grid = common::makeOccupancyGrid(*rc::gen::elementOf(std::vector<double>{0.02, 0.04, 0.05, 0.1, 0.3}));
  const int count = *rc::gen::inRange(0, 60);
  for (int i = 0; i < count; ++i)
    grid.set({*rc::gen::inRange(-150, 150), *rc::gen::inRange(-150, 150)},
             static_cast<occupancy::Cell>(*rc::gen::inRange(-100, 101)));
  RC_ASSERT(writeMap(folder, "m", grid).has_value());
  const StoredMap map = readMap(folder / "m.yaml");
  RC_ASSERT(map.T_map_grid.x_m == 0.0);
  RC_ASSERT(map.T_map_grid.y_m == 0.0);
  RC_ASSERT(sameKinds(grid, map.grid));
}

// The rules of map_server in an independent implementation, in another language.
TEST(MapServer, AnIndependentReaderSeesTheSameMap) {
  if (!outputOf("python3 -c 'import yaml' 2>/dev/null")) GTEST_SKIP() << "no python3 with yaml on this machine";
  const ScratchFolder folder;
  ASSERT_TRUE(writeMap(folder, "map", smallGrid()));
  put(folder / "read.py", R"(
import json, sys, yaml
meta = yaml.safe_load(open(sys.argv[1] + '/map.yaml'))
data = open(sys.argv[1] + '/' + meta['image'], 'rb').read()
lines = [l for l in data.split(b'\n', 4)]
assert lines[0] == b'P5' and lines[1].startswith(b'#') and lines[3] == b'255'
w, h = map(int, lines[2].split()); pixels = lines[4]
assert len(pixels) == w * h
cells = []
for row in range(h):
  for col in range(w):
    occ = (255 - pixels[row * w + col]) / 255.0
    if meta['negate']: occ = 1 - occ
    value = 100 if occ > meta['occupied_thresh'] else 0 if occ < meta['free_thresh'] else -1
    x = meta['origin'][0] + (col + 0.5) * meta['resolution']
    y = meta['origin'][1] + (h - 1 - row + 0.5) * meta['resolution']
    cells.append([x, y, value])
print(json.dumps(cells))
)");
  const auto output = outputOf("python3 " + (folder / "read.py").string() + " " + folder.path().string());
  ASSERT_TRUE(output);
  const auto cells = nlohmann::json::parse(*output);
  ASSERT_EQ(cells.size(), 6u);
  for (const auto& cell : cells) {
    const occupancy::Cell ours = smallGrid().at(smallGrid().cellAt(cell[0].get<double>(), cell[1].get<double>()));
    const int expected = occupancy::isUnknown(ours) ? -1 : occupancy::isOccupied(ours) ? 100 : 0;
    EXPECT_EQ(cell[2].get<int>(), expected) << cell;
  }
}

/// A map of two pixels with the given yaml lines beside the required ones.
StoredMap readTwo(const fs::path& folder, const std::string& pixels, const std::string& extra) {
  put(folder / "m.pgm", "P5 2 1 255\n" + pixels);
  put(folder / "m.yaml", "image: m.pgm\nresolution: 0.5\n" + extra);
  return readMap(folder / "m.yaml");
}

TEST(MapServer, FollowsModeThresholdsAndNegate) {
  const ScratchFolder folder;
  const std::string origin = "origin: [0, 0, 0]\n";
  const std::string grey = {static_cast<char>(40), static_cast<char>(128)};  // Probabilities 0.84 and 0.50.
  EXPECT_EQ(kind(readTwo(folder, grey, origin).grid.at({0, 0})), '#');
  EXPECT_EQ(kind(readTwo(folder, grey, origin).grid.at({1, 0})), '?');
  for (const std::string negate : {"1", "true"})
    EXPECT_EQ(kind(readTwo(folder, grey, origin + "negate: " + negate + "\n").grid.at({0, 0})), '.');
  EXPECT_EQ(kind(readTwo(folder, grey, origin + "negate: false\n").grid.at({0, 0})), '#');
  EXPECT_EQ(kind(readTwo(folder, grey, origin + "occupied_thresh: 0.9\n").grid.at({0, 0})), '?');
  EXPECT_EQ(kind(readTwo(folder, grey, origin + "free_thresh: 0.51\n").grid.at({1, 0})), '.');
  const auto scaled = readTwo(folder, grey, origin + "mode: scale\noccupied_thresh: 0.9\nfree_thresh: 0.1\n");
  EXPECT_NEAR(occupancy::probability(scaled.grid.at({0, 0})), (215 / 255.0 - 0.1) / 0.8, 0.01);
  const auto raw = readTwo(folder, {static_cast<char>(80), static_cast<char>(255)}, origin + "mode: raw\n");
  EXPECT_NEAR(occupancy::probability(raw.grid.at({0, 0})), 0.8, 0.01);
  EXPECT_EQ(kind(raw.grid.at({1, 0})), '?');
}

TEST(MapServer, PlacesAMapByItsOrigin) {
  const ScratchFolder folder;
  const std::string pixels = {static_cast<char>(0), static_cast<char>(254)};
  const auto shifted = readTwo(folder, pixels, "origin: [-1.5, 1.0, 0.0]\n");
  EXPECT_EQ(kind(shifted.grid.at({-3, 2})), '#');
  EXPECT_EQ(shifted.T_map_grid.x_m, 0.0);
  // This origin is not on the lattice of cells, so the grid and the remaining transform give it together.
  const auto between = readTwo(folder, pixels, "origin: [-1.3, 1.0, 0.0]\n");
  EXPECT_EQ(kind(between.grid.at({-3, 2})), '#');
  EXPECT_NEAR((between.T_map_grid * between.grid.centerOf({-3, 2})).x(), -1.3 + 0.25, 1e-12);
  const auto turned = readTwo(folder, pixels, "origin: [1.0, 2.0, 1.5707963267948966]\n");
  EXPECT_NEAR((turned.T_map_grid * turned.grid.centerOf({1, 0}) - Eigen::Vector2d(0.75, 2.75)).norm(), 0, 1e-12);
}

TEST(MapServer, ReadsAsciiPicturesAndSmallGreyRanges) {
  const GreyImage image = parsePgm("P2 # comment\n2 # another\n2\n15\n0 15\n# third\n7 3\n", "p");
  EXPECT_EQ(image.width_px, 2);
  EXPECT_EQ(image.pixels, std::string("\x00\xff\x77\x33", 4));
}

TEST(MapServer, ReportsThePlaceOfMistakesInPictures) {
  const auto problem = [](const std::string& bytes) { return problemOf([&] { parsePgm(bytes, "m.pgm"); }); };
  EXPECT_THAT(problem(""), HasSubstr("m.pgm:1: PGM: begins with ``, P5 or P2 was expected"));
  EXPECT_THAT(problem("\x89PNG"), HasSubstr("P5 or P2 was expected"));
  EXPECT_THAT(problem("P5\n# c\n0 3\n255\n"), HasSubstr("m.pgm:3: width: `0` is not a whole number from 1"));
  EXPECT_THAT(problem("P5\n2\nx\n255\n"), HasSubstr("m.pgm:3: height: `x`"));
  EXPECT_THAT(problem("P5\n2 2\n65536\n"), HasSubstr("m.pgm:3: greatest value: `65536`"));
  EXPECT_THAT(problem("P5\n2 2\n65535\n"),
              HasSubstr("m.pgm:3: greatest value: 65535 is that of 16 bits a pixel, 8 can be read, convert it"));
  EXPECT_THAT(problem("P5\n32000 32000\n255\nabc"), HasSubstr("m.pgm:3: pixels: the file ends after 3 of 1024000000"));
  EXPECT_THAT(problem("P2\n2 2\n9\n1 2 3 "), HasSubstr("pixels: the file ends after 3 of 4 pixels"));
  EXPECT_THAT(problem("P2\n2 2\n9\n1 2\n10 3\n"), HasSubstr("m.pgm:5: pixel: `10` is not a whole number from 0 to 9"));
}

TEST(MapServer, ReportsThePlaceOfMistakesInYaml) {
  const ScratchFolder folder;
  const auto problem = [&](const std::string& yaml) {
    put(folder / "m.yaml", yaml);
    return problemOf([&] { readMap(folder / "m.yaml"); });
  };
  const std::string good = "image: m.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n";
  EXPECT_THAT(problem("image: m.pgm\n"), HasSubstr("resolution: is missing"));
  EXPECT_THAT(problem("resolution: 0.05\norigin: [0, 0, 0]\n"), HasSubstr("image: is missing"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, 0]\n"), HasSubstr("m.yaml:3:"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, .nan, 0]\n"),
              HasSubstr("m.yaml:3:13: origin[1]: nan is not within"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: .inf\norigin: [0, 0, 0]\n"), HasSubstr("is not within 0.001 and"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 1e-9\norigin: [9, 0, 0]\n"), HasSubstr("is not within 0.001 and"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, -1e300, 0]\n"),
              HasSubstr("origin[1]: -1e+300 is not within"));
  EXPECT_THAT(problem(good + "free_thresh: 0.7\n"), HasSubstr("free_thresh: is not below occupied_thresh"));
  EXPECT_THAT(problem(good + "mode: colour\n"), HasSubstr("m.yaml:4:"));
  EXPECT_THAT(problem(good + "treshold: 1\n"), HasSubstr("unknown key `treshold`"));
  EXPECT_THAT(problem("image: m.png\nresolution: 0.05\norigin: [0, 0, 0]\n"), HasSubstr("is not a .pgm picture"));
  EXPECT_THAT(problem(good), HasSubstr("m.pgm`: no such file"));
  EXPECT_THAT(problem(good + "negate: 2\n"), HasSubstr("m.yaml:4:"));
  std::filesystem::create_symlink("m.pgm", folder / "m.pgm");
  EXPECT_THAT(problem(good), HasSubstr("m.pgm`: Too many levels of symbolic links"));
}

struct Counts {
  int width, height, occupied, free, unknown;
};

// The counts were taken from the files by a histogram of their pixels.
TEST(MapServer, ReadsMapsOfOtherTools) {
  const auto folder = test_support::dataSet("05-occupancy-maps");
  if (!folder) return;
  const std::map<std::string, Counts> expected = {
      {"aws-small-house/map", {500, 500, 3442, 63021, 183537}},
      {"aws-small-warehouse-002/map", {1536, 1504, 14173, 585573, 1710398}},
      {"hector-small-indoor/small_indoor_scenario_edited_map_hector_mapping", {768, 768, 3966, 34432, 551426}},
      {"lse-arena/lse_arena", {80, 60, 345, 4455, 0}},
      {"nav2-smoothers-world/smoothers_world", {300, 300, 10576, 79424, 0}},
      {"nav2-depot/depot", {604, 307, 5947, 179481, 0}},  // free_thresh 0.25 takes its 205 for free, as nav2 does.
      {"nav2-tb3-sandbox/tb3_sandbox", {384, 384, 870, 7903, 138683}},
  };
  const ScratchFolder scratch;
  for (const auto& [name, counts] : expected) {
    const fs::path source = *folder / (name + ".yaml");
    const std::string stem = source.stem().string();
    put(scratch / (stem + ".yaml"), bytesOf(source));
    put(scratch / (stem + ".pgm"), outputOf("zcat " + (*folder / (name + ".pgm.gz")).string()).value_or(""));
    const StoredMap map = readMap(scratch / (stem + ".yaml"));
    int occupied = 0, free = 0;
    map.grid.forEachCell([&](CellIndex, occupancy::Cell cell) {
      occupied += occupancy::isOccupied(cell) && !occupancy::isUnknown(cell) ? 1 : 0;
      free += occupancy::isFree(cell) ? 1 : 0;
    });
    EXPECT_EQ(occupied, counts.occupied) << name;
    EXPECT_EQ(free, counts.free) << name;
    EXPECT_EQ(counts.width * counts.height - occupied - free, counts.unknown) << name;
    EXPECT_LE(map.T_map_grid.position_m().cwiseAbs().maxCoeff(), 0.5 * map.grid.resolution_m() + 1e-9) << name;
  }
}

}  // namespace
}  // namespace swiftlet::interfaces
