// Maps that other tools read, and maps of other tools.
#include "interfaces/files/map_server.hpp"

#include <map>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include "png_bytes.hpp"
#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;
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
    EXPECT_THAT(problemsOf([&] { readMap(folder / (name + ".yaml")); }), HasProblem("map.no-image")) << name;
  }
  EXPECT_THAT(toMapYaml(smallGrid(), "ground floor.pgm"), HasSubstr("image: ground floor.pgm\n"));
  EXPECT_THAT(toMapYaml(smallGrid(), "it's.pgm"), HasSubstr("image: 'it''s.pgm'\n"));
}

TEST(MapServer, APictureMayBePacked) {
  const ScratchFolder folder;
  ASSERT_TRUE(writeMap(folder, "map", smallGrid()));
  ASSERT_EQ(std::system(("gzip '" + (folder / "map.pgm").string() + "'").c_str()), 0);
  EXPECT_TRUE(sameKinds(readMap(folder / "map.yaml").grid, smallGrid()));
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

// map_saver of ROS 2 writes 205 for unknown and free_thresh 0.25, by which 205 would be free.
TEST(MapServer, UnknownStaysUnknownWhateverFreeThreshSays) {
  const ScratchFolder folder;
  const std::string origin = "origin: [0, 0, 0]\n", pixels = {static_cast<char>(205), static_cast<char>(254)};
  for (const std::string free_thresh : {"0.196", "0.25", "0.4"}) {
    const StoredMap map = readTwo(folder, pixels, origin + "free_thresh: " + free_thresh + "\n");
    EXPECT_EQ(kind(map.grid.at({0, 0})), '?') << free_thresh;
    EXPECT_EQ(kind(map.grid.at({1, 0})), '.') << free_thresh;
    EXPECT_EQ(map.notes.empty(), free_thresh == "0.196");
  }
  EXPECT_THAT(readTwo(folder, pixels, origin + "free_thresh: 0.25\n").notes,
              ElementsAre(ProblemIs("map.unknown-as-free", "m.yaml:4:14: free_thresh")));
  const std::string inverted = {static_cast<char>(50), static_cast<char>(1)};
  EXPECT_EQ(kind(readTwo(folder, inverted, origin + "negate: 1\nfree_thresh: 0.25\n").grid.at({0, 0})), '?');
  // Other greys follow the thresholds.
  EXPECT_EQ(kind(readTwo(folder, {static_cast<char>(200), '\0'}, origin + "free_thresh: 0.25\n").grid.at({0, 0})), '.');
}

TEST(MapServer, OfModeScaleTheGreyOfUnknownIsThatWhereNothingIsTransparent) {
  const ScratchFolder folder;
  const std::string origin = "origin: [0, 0, 0]\nmode: scale\n",
                    pixels = {static_cast<char>(205), static_cast<char>(254)};
  for (const std::string free_thresh : {"0.196", "0.25"}) {
    const StoredMap map = readTwo(folder, pixels, origin + "free_thresh: " + free_thresh + "\n");
    EXPECT_EQ(kind(map.grid.at({0, 0})), '?');
    EXPECT_EQ(kind(map.grid.at({1, 0})), '.');
    EXPECT_THAT(map.notes, ElementsAre(ProblemIs("map.unknown-as-free", "m.yaml:4:7: mode")));
  }
  // With transparent pixels, which say unknown, it is a probability.
  put(folder / "m.png", pngOf(2, 1, {static_cast<char>(205), static_cast<char>(255), '\0', '\0'}, {.color_type = 4}));
  put(folder / "m.yaml", "image: m.png\nresolution: 0.5\nfree_thresh: 0.25\n" + origin);
  const StoredMap map = readMap(folder / "m.yaml");
  EXPECT_EQ(kind(map.grid.at({0, 0})), '.');
  EXPECT_THAT(map.notes, testing::IsEmpty());
}

TEST(MapServer, OfModeRawNumbersThatAreNoPercentagesAreNoted) {
  const ScratchFolder folder;
  const std::string raw = "origin: [0, 0, 0]\nmode: raw\n";
  EXPECT_THAT(readTwo(folder, {'\0', static_cast<char>(254)}, raw).notes,
              ElementsAre(ProblemIs("map.beyond-percent", "m.yaml:4:7: mode", "`mode: trinary`")));
  EXPECT_THAT(readTwo(folder, {'d', static_cast<char>(255)}, raw).notes, testing::IsEmpty());
}

TEST(MapServer, TransparentPixelsAreUnknown) {
  const ScratchFolder folder;
  const std::string row = {'\0', '\0', static_cast<char>(254), static_cast<char>(255), '\0', static_cast<char>(200)};
  put(folder / "m.png", pngOf(3, 1, row, {.color_type = 4}));
  const auto kinds = [&](const std::string& mode) {
    put(folder / "m.yaml", "image: m.png\nresolution: 0.5\norigin: [0, 0, 0]\nmode: " + mode + "\n");
    const OccupancyGrid grid = readMap(folder / "m.yaml").grid;
    return std::string{kind(grid.at({0, 0})), kind(grid.at({1, 0})), kind(grid.at({2, 0}))};
  };
  EXPECT_EQ(kinds("trinary"), "?.#") << "an edge that is drawn smoothly still is one";
  EXPECT_EQ(kinds("scale"), "?.?");
}

TEST(MapServer, TakesTheWordsOfOtherPrograms) {
  const ScratchFolder folder;
  const std::string origin = "origin: [0, 0, 0]\n", pixels = {'\0', static_cast<char>(254)};
  for (const std::string negate : {"1", "true", "True", "yes"})
    EXPECT_EQ(kind(readTwo(folder, pixels, origin + "negate: " + negate + "\n").grid.at({0, 0})), '.') << negate;
  for (const std::string negate : {"0", "False", "no", "off"})
    EXPECT_EQ(kind(readTwo(folder, pixels, origin + "negate: " + negate + "\n").grid.at({0, 0})), '#') << negate;
  EXPECT_EQ(kind(readTwo(folder, pixels, origin + "mode: Trinary\n").grid.at({0, 0})), '#');
  const StoredMap map = readTwo(folder, pixels, origin + "width: 2\nstatic_layer:\n  track_unknown_space: true\n");
  EXPECT_EQ(kind(map.grid.at({0, 0})), '#');
  EXPECT_THAT(map.notes, ElementsAre(ProblemIs("config.key-not-used", "m.yaml:4:1"),
                                     ProblemIs("config.key-not-used", "m.yaml:5:1")));
  EXPECT_THAT(readTwo(folder, pixels + "\n\n", origin).notes,
              ElementsAre(ProblemIs("map.bytes-left-over", "m.yaml:1:8: image")));
}

TEST(MapServer, SuspectsDegrees) {
  const ScratchFolder folder;
  const std::string pixels = {'\0', static_cast<char>(254)};
  EXPECT_THAT(readTwo(folder, pixels, "origin: [0, 0, 90]\n").notes,
              ElementsAre(ProblemIs("map.yaw-beyond-turn", "m.yaml:3:9: origin")));
  for (const std::string yaw : {"0", "1.5708", "-3.14159", "6.2831853"})
    EXPECT_TRUE(readTwo(folder, pixels, "origin: [0, 0, " + yaw + "]\n").notes.empty()) << yaw;
  EXPECT_EQ(readTwo(folder, pixels, "origin: [0, 0, -45]\n").notes.size(), 1u);
}

/// What the hints say, done literally, is read.
TEST(MapServer, SaysHowTheOriginIsWritten) {
  const ScratchFolder folder;
  const std::string pixels = {'\0', static_cast<char>(254)};
  const auto problem = [&](const std::string& origin) {
    return problemsOf([&] { readTwo(folder, pixels, "origin: " + origin + "\n"); });
  };
  for (const std::string origin : {"-1.55 -1.55 0", "(-1.55, -1.55, 0)", "-1.55; -1.55; 0", "[-1.55; -1.55; 0]",
                                   "[-1.55 -1.55 0]", "[-1.55 -1.55, 0]", "[(-1.55, -1.55, 0)]", "-1,55; -1,55; 0"})
    EXPECT_THAT(problem(origin), HasProblem(kAnyName, "", "`[-1.55, -1.55, 0]`")) << origin;
  EXPECT_EQ(readTwo(folder, pixels, "origin: [-1.55, -1.55, 0]\n").notes.size(), 0u);
  for (const std::string yaw : {"45°", "45 °", "45deg", "'45 degrees'", "45\xB0"})
    EXPECT_THAT(problem("[0, 0, " + yaw + "]"), HasProblem("config.other-type", "origin", "`0.785398`")) << yaw;
}

TEST(MapServer, TakesThePictureBesideTheYaml) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& image) {
    put(folder / "m.yaml", "image: " + image + "\nresolution: 0.5\norigin: [0, 0, 0]\n");
    return readMap(folder / "m.yaml");
  };
  put(folder / "m.pgm", std::string("P5 1 1 255\n\0", 12));
  for (const std::string image :
       {"/opt/robot/maps/m.pgm", "maps/m.pgm", "'C:\\maps\\m.pgm'", "'~/no such folder/m.pgm'",
        "file:///opt/robot/m.pgm", "package://robot/maps/m.pgm", "$(find robot)/maps/m.pgm"})
    EXPECT_THAT(read(image).notes, ElementsAre(ProblemIs("map.image-beside", "", "`image: m.pgm`"))) << image;
  EXPECT_TRUE(read("m.pgm").notes.empty());
  EXPECT_TRUE(read((folder / "m.pgm").string()).notes.empty());
  EXPECT_TRUE(read("file://" + (folder / "m.pgm").string()).notes.empty());
  EXPECT_TRUE(read("file://" + (folder / "%6d.pgm").string()).notes.empty());
  const auto offer = HasProblem("map.no-image", "m.yaml:1:8: image", "`image: m.pgm`");
  EXPECT_THAT(problemsOf([&] { read("M.PGM"); }), offer);
  EXPECT_THAT(problemsOf([&] { read("m.png"); }), offer);
  EXPECT_THAT(problemsOf([&] { read("/opt/robot/other.pgm"); }), offer);
  fs::remove(folder / "m.pgm");
  EXPECT_THAT(problemsOf([&] { read("/opt/robot/m.pgm"); }),
              HasProblem("map.no-image", "m.yaml:1:8: image", "`/opt/robot/m.pgm`"));
}

TEST(MapServer, NamesTheYamlOfAPictureThatIsGivenInItsPlace) {
  const ScratchFolder folder;
  const auto problem = [&] { return problemsOf([&] { readMap(folder / "m.pgm"); }); };
  put(folder / "m.pgm", std::string("P5 1 1 255\n\0", 12));
  EXPECT_THAT(problem(), HasProblem("map.is-picture", "m.pgm", "`image: m.pgm`"));
  put(folder / "floor.yaml", "image: m.pgm\n");
  EXPECT_THAT(problem(), HasProblem("map.is-picture", "m.pgm", (folder / "floor.yaml").string()));
  put(folder / "m.yaml", "image: m.pgm\n");
  EXPECT_THAT(problem(), HasProblem("map.is-picture", "m.pgm", (folder / "m.yaml").string()));
}

TEST(MapServer, ReadsTheFieldCases) {
  const auto folder = test_support::dataSet("10-field-cases");
  if (!folder) return;
  const std::map<std::string, std::string> notes = {
      {"map_extra_bytes/comment_last.yaml", ""},
      {"map_extra_keys/width.yaml", "config.key-not-used"},
      {"map_image_path/abs_other.yaml", "map.image-beside"},
      {"map_yaw_degrees/deg.yaml", "map.yaw-beyond-turn"},
      {"map_free_thresh/map025.yaml", "map.unknown-as-free"},
      {"map_free_thresh/map0196.yaml", ""},
      {"map_pictures/p16.yaml", ""},
      {"map_pictures/pal_png.yaml", ""},
      {"map_pictures/rgba_png.yaml", ""},
  };
  for (const auto& [file, note] : notes) {
    const StoredMap map = readMap(*folder / file);
    if (note.empty())
      EXPECT_TRUE(map.notes.empty()) << file;
    else
      EXPECT_THAT(map.notes, HasProblem(note)) << file;
  }
  EXPECT_TRUE(sameKinds(readMap(*folder / "map_free_thresh/map025.yaml").grid,
                        readMap(*folder / "map_free_thresh/map0196.yaml").grid));
  EXPECT_THAT(problemsOf([&] { readMap(*folder / "lfs_pointer/lfs.yaml"); }),
              HasProblem("file.pointer", "lfs.pgm", "`git lfs pull`"));
}

TEST(MapServer, ReportsThePlaceOfMistakesInYaml) {
  const ScratchFolder folder;
  const auto problem = [&](const std::string& yaml) {
    put(folder / "m.yaml", yaml);
    return problemsOf([&] { readMap(folder / "m.yaml"); });
  };
  const std::string good = "image: m.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n";
  EXPECT_THAT(problem("image: m.pgm\n"), HasProblem("config.missing", "resolution"));
  EXPECT_THAT(problem("resolution: 0.05\norigin: [0, 0, 0]\n"), HasProblem("config.missing", "image"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, 0]\n"),
              HasProblem("map.origin", "m.yaml:3:9: origin"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, .nan, 0]\n"),
              HasProblem("config.not-within", "m.yaml:3:13: origin[1]"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: .inf\norigin: [0, 0, 0]\n"), HasProblem("config.not-within"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 1e-9\norigin: [9, 0, 0]\n"), HasProblem("config.not-within"));
  EXPECT_THAT(problem("image: m.pgm\nresolution: 0.05\norigin: [0, -1e300, 0]\n"),
              HasProblem("config.not-within", "origin[1]"));
  EXPECT_THAT(problem(good + "free_thresh: 0.7\n"), HasProblem("map.thresholds", "free_thresh"));
  EXPECT_THAT(problem(good + "mode: colour\n"), HasProblem("map.mode", "m.yaml:4:7: mode"));
  EXPECT_THAT(problem(good + "fre_thresh: 0.1\n"), HasProblem("config.unknown-key", "", "`free_thresh`"));
  EXPECT_THAT(problem("image: m.png\nresolution: 0.05\norigin: [0, 0, 0]\n"), HasProblem("map.no-image"));
  EXPECT_THAT(problem(good), HasProblem("map.no-image"));
  EXPECT_THAT(problem(good + "negate: 2\n"), HasProblem("map.negate", "m.yaml:4:9: negate"));
  std::filesystem::create_symlink("m.pgm", folder / "m.pgm");
  EXPECT_THAT(problem(good), HasProblem("map.no-image"));
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
      {"nav2-depot/depot", {604, 307, 5947, 170587, 8894}},  // Its free_thresh is 0.25.
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
