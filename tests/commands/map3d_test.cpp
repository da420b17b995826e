// swiftlet map3d as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/hash.hpp"
#include "common/image_decoder.hpp"
#include "common/png_encoder.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/archive.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/tum.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class Map3d : public test_support::Scratch {};

TEST_F(Map3d, RefusesAFolderWithoutFramesAndLeavesNothing) {
  fs::create_directories(folder_ / "empty");
  const ProgramEnd end = runSwiftlet({"map3d", path("empty"), "--out", path("out")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("empty: holds no RGB-D frames of a known format, expected associations.txt"));
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(Map3d, SaysWhatAFrameNeedsWhereNoneCanBeUsed) {
  fs::create_directories(folder_ / "junk");
  write("junk/associations.txt", "0.1 a.png 0.1 b.png\n");
  write("junk/a.png", "no picture");
  write("junk/b.png", "no depths");
  const ProgramEnd end = runSwiftlet({"map3d", path("junk"), "--out", path("out")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("junk: of 1 frame none can be used, the notes above say why"));
  fs::remove(folder_ / "junk/a.png");
  EXPECT_THAT(runSwiftlet({"map3d", path("junk"), "--out", path("out")}).err,
              HasSubstr("none can be used, are the images of the list in the folder?"));
  EXPECT_THAT(end.err, HasSubstr("1 frame was skipped")) << "the note above";
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(Map3d, NamesTheSettingOfACalibrationThatIsWrong) {
  fs::create_directories(folder_ / "frames");
  write("frames/associations.txt", "0.1 a.png 0.1 b.png\n");
  const std::string file = write("lens.yaml", "color: {fx_pix: 500}\n");
  const ProgramEnd end = runSwiftlet({"map3d", path("frames"), "--intrinsics", file, "--out", path("out")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("did you mean `fx_px`?"));
}

/// The few first frames of the recorded kitchen, if there are data sets here. Instead of the first `foreign` ones it
/// has frames from the end of the recording.
std::optional<fs::path> kitchenFrames(const fs::path& scratch, int frames, int foreign = 0) {
  const auto archive = test_support::dataSet("03-rgbd/7scenes-redkitchen-a/redkitchen_000-598_step2.tar");
  if (!archive) return std::nullopt;
  const fs::path all = interfaces::unpackInto(scratch, *archive);
  const fs::path some = scratch / "some";
  fs::create_directories(some);
  for (int i = 0; i < 2 * frames; i += 2)
    for (const char* kind : {"color.jpg", "depth.png"}) {
      const int shown = i < 2 * foreign ? 590 + i : i;
      fs::copy_file(all / fmt::format("frame-{:06}.{}", shown, kind), some / fmt::format("frame-{:06}.{}", i, kind));
    }
  return some;
}

TEST_F(Map3d, ADiskThatFillsUpLeavesNothingHalfWrittenAndKeepsOlderResults) {
  const auto some = kitchenFrames(folder_, 3);
  if (!some) return;
  test_support::ProgramOptions full;
  full.largest_file_bytes = 50'000;
  const std::vector<std::string> command = {"map3d", some->string(), "--out", path("out")};
  const ProgramEnd first = runSwiftlet(command, full);
  EXPECT_EQ(first.exit_code, 2) << describe(first);
  EXPECT_THAT(first.err, HasSubstr("cloud.ply: File too large"));
  EXPECT_FALSE(fs::exists(path("out")));

  const ProgramEnd whole = runSwiftlet(command);
  ASSERT_EQ(whole.exit_code, 0) << describe(whole);
  const std::string cloud = readText(path("out/cloud.ply"));
  EXPECT_EQ(runSwiftlet(command, full).exit_code, 2);
  EXPECT_EQ(readText(path("out/cloud.ply")), cloud);
  EXPECT_FALSE(fs::exists(path("out/unfinished.part")));
}

TEST_F(Map3d, MapsARecordedFolderAndSaysWhatItSkipped) {
  const auto frames = kitchenFrames(folder_, 20);
  if (!frames) return;
  const fs::path& some = *frames;
  fs::resize_file(some / "frame-000010.depth.png", 5'000);
  const ProgramEnd end =
      runSwiftlet({"map3d", some.string(), "--out", path("out"), "--mesh", path("out/mesh.ply"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const nlohmann::json figures = nlohmann::json::parse(end.out);
  EXPECT_EQ(figures.at("format"), "7-Scenes");
  EXPECT_EQ(figures.at("frames"), 19);
  EXPECT_EQ(figures.at("skipped_frames"), 1);
  EXPECT_EQ(figures.at("lost_frames"), 0);
  EXPECT_THAT(figures.at("notes").dump(), HasSubstr("frame-000010.depth.png: is cut off"));
  EXPECT_EQ(interfaces::readTum(path("out/trajectory.tum")).size(), 19u);
  EXPECT_GT(fs::file_size(path("out/cloud.ply")), 100'000u);
  EXPECT_GT(interfaces::readCloud(path("out/mesh.ply")).points.size(), 1'000u) << "the vertices; faces are left out";
  EXPECT_GT(figures.at("mesh_triangles"), 2'000);
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("<title>3D map of some"));
}

/// A shelf 0.35 m from the camera, with boards across and a back 0.1 m behind their edges; x right, y down, z along the
/// view. It has no ends.
constexpr double kEdges_m = 0.35, kBack_m = 0.45;
constexpr std::array<std::array<double, 2>, 3> kBoards_m{{{-0.11, -0.09}, {-0.01, 0.01}, {0.09, 0.11}}};

/// How far along the view a ray with this slope meets the shelf.
double shelfDepth_m(double down) {
  double depth_m = kBack_m;
  for (const auto& [upper_m, lower_m] : kBoards_m)
    for (const double edge_m : {upper_m, lower_m}) {
      const double at_edges_m = down * kEdges_m;
      if (at_edges_m >= upper_m && at_edges_m <= lower_m) depth_m = std::min(depth_m, kEdges_m);
      const double at_m = edge_m / down;
      if (at_m > kEdges_m && at_m < depth_m) depth_m = at_m;
    }
  return depth_m;
}
double shelfDistance_m(const Eigen::Vector3d& point_m) {
  double least_m = std::abs(point_m.z() - kBack_m);
  for (const auto& [upper_m, lower_m] : kBoards_m) {
    const double dy = std::max({upper_m - point_m.y(), 0.0, point_m.y() - lower_m});
    const double dz = std::max(kEdges_m - point_m.z(), 0.0);
    const double inside_m = std::min({point_m.y() - upper_m, lower_m - point_m.y(), point_m.z() - kEdges_m});
    least_m = std::min(least_m, inside_m > 0.0 ? inside_m : std::hypot(dy, dz));
  }
  return least_m;
}

/// Patches of 6 mm and of 25 mm, each of its own brightness.
std::uint8_t shelfGrey(const Eigen::Vector3d& point_m) {
  double sum = 0.0;
  for (const double side_m : {0.006, 0.025}) {
    const std::string patch = fmt::format("{} {} {}", std::floor(point_m.x() / side_m),
                                          std::floor(point_m.y() / side_m), std::floor(point_m.z() / side_m));
    sum += static_cast<double>(common::fnv1a(patch) % 120);
  }
  return static_cast<std::uint8_t>(10.0 + sum);
}

/// A recording in the format of Open3D, of a camera that moves along the shelf.
void writeShelf(const fs::path& folder) {
  fs::create_directories(folder / "color");
  fs::create_directories(folder / "depth");
  const auto put = [&](const std::string& name, const std::vector<std::uint8_t>& png) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  };
  for (int i = 0; i < 8; ++i) {
    common::Image color{320, 240, {}};
    common::DepthCodes depth{320, 240, {}};
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) {
        const double right = (u - 159.5) / 262.5, down = (v - 119.5) / 262.5, depth_m = shelfDepth_m(down);
        depth.codes.push_back(static_cast<std::uint16_t>(std::lround(1000.0 * depth_m)));
        color.rgb.insert(color.rgb.end(), 3, shelfGrey({0.004 * i + right * depth_m, down * depth_m, depth_m}));
      }
    put(fmt::format("color/{:06}.png", i), common::encodePng(color));
    put(fmt::format("depth/{:06}.png", i), common::encodePng(depth));
  }
  std::ofstream(folder / "camera_intrinsic.json")
      << R"({"width": 320, "height": 240, "intrinsic_matrix": [262.5, 0, 0, 0, 262.5, 0, 159.5, 119.5, 1]})";
}

/// The mesh is within 5 mm of what the depths show.
TEST_F(Map3d, AShelfAtFortyCentimetresIsMappedToFiveMillimetres) {
  writeShelf(folder_ / "shelf");
  const auto map = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"map3d", path("shelf"), "--out", path("out"), "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const ProgramEnd end = runSwiftlet(command);
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return nlohmann::json::parse(end.out);
  };
  map({});
  const std::size_t usual = interfaces::readCloud(path("out/cloud.ply")).points.size();
  const nlohmann::json figures = map({"--resolution", "0.005", "--mesh", path("shelf.obj")});
  EXPECT_EQ(figures.at("format"), "Open3D");
  EXPECT_EQ(figures.at("lost_frames"), 0);
  EXPECT_GT(interfaces::readCloud(path("out/cloud.ply")).points.size(), 8 * usual) << "16 times as many cubes";
  EXPECT_EQ(interfaces::readOctree(path("out/map.bt")).map.resolution_m(), 0.005);
  std::ifstream mesh(path("shelf.obj"));
  std::size_t vertices = 0, triangles = 0, beyond = 0;
  for (std::string line; std::getline(mesh, line);) {
    std::istringstream words(line);
    std::string kind;
    Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
    words >> kind >> point_m.x() >> point_m.y() >> point_m.z();
    triangles += kind == "f" ? 1 : 0;
    if (kind != "v") continue;
    ++vertices;
    beyond += shelfDistance_m(point_m) > 0.005 ? 1 : 0;
  }
  EXPECT_EQ(triangles, figures.at("mesh_triangles"));
  EXPECT_GT(vertices, 4'000u);
  EXPECT_LT(static_cast<double>(beyond), 0.01 * static_cast<double>(vertices));
}

TEST_F(Map3d, AMeshOfAnotherKindIsRefusedBeforeAnythingIsMapped) {
  writeShelf(folder_ / "shelf");
  const ProgramEnd end = runSwiftlet({"map3d", path("shelf"), "--out", path("out"), "--mesh", path("shelf.stl")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("shelf.stl: --mesh: is not named .ply or .obj"));
  EXPECT_FALSE(fs::exists(path("out")));
}

/// The mean of the points, and of the occupied voxels: they tell one frame from another.
Eigen::Vector3d middleOfCloud(const fs::path& file) {
  const auto points = interfaces::readCloud(file).points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const common::SurfacePoint& point : points) sum += point.position_m.cast<double>();
  return sum / static_cast<double>(points.size());
}
Eigen::Vector3d middleOfVoxels(const fs::path& file) {
  const common::VoxelMap map = interfaces::readOctree(file).map;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const common::VoxelIndex block : map.blocks())
    for (int i = 0; i < common::VoxelBlock::kVoxels; ++i)
      if (const auto voxel = common::VoxelMap::voxelOf(block, i); map.isOccupied(voxel)) {
        sum += map.centerOf(voxel);
        ++count;
      }
  return sum / count;
}

/// A world with z upwards, in which poses are given.
const common::Pose3 T_world_own{common::expSO3({-1.6, 0.2, 0.4}), {3.0, -2.0, 1.0}};

/// Lines of poses in that world, from the `first` on.
std::string posesInWorld(const common::Trajectory& own, std::size_t first) {
  std::string lines;
  for (std::size_t i = first; i < own.size(); ++i)
    lines += interfaces::toTumLine({own[i].stamp, T_world_own * own[i].pose});
  return lines;
}

/// All results are in the world of the poses.
TEST_F(Map3d, WithGivenPosesTheResultsAreInTheirWorld) {
  const auto some = kitchenFrames(folder_, 10);
  if (!some) return;
  ASSERT_EQ(runSwiftlet({"map3d", some->string(), "--out", path("out")}).exit_code, 0);
  const common::Trajectory own = interfaces::readTum(path("out/trajectory.tum"));
  const std::string poses = posesInWorld(own, 0);
  const ProgramEnd seeded =
      runSwiftlet({"map3d", some->string(), "--poses", write("poses.tum", poses), "--out", path("seeded"), "--json"});
  ASSERT_EQ(seeded.exit_code, 0) << describe(seeded);
  const nlohmann::json figures = nlohmann::json::parse(seeded.out);
  EXPECT_EQ(figures.at("lost_frames"), 0);
  EXPECT_EQ(figures.at("frames_with_pose"), 10);
  EXPECT_THAT(figures.at("notes").dump(), testing::Not(HasSubstr("pose"))) << "nothing is odd about the poses";
  const common::Trajectory in_world = interfaces::readTum(path("seeded/trajectory.tum"));
  ASSERT_EQ(in_world.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const common::Pose3 expected = T_world_own * own[i].pose;
    EXPECT_LT((in_world[i].pose.position_m - expected.position_m).norm(), 0.02) << i;
    EXPECT_LT(in_world[i].pose.rotation.angularDistance(expected.rotation), 0.02) << i;
  }
  EXPECT_LT((middleOfCloud(path("seeded/cloud.ply")) - T_world_own * middleOfCloud(path("out/cloud.ply"))).norm(), 0.1);
  EXPECT_LT((middleOfVoxels(path("seeded/map.bt")) - T_world_own * middleOfVoxels(path("out/map.bt"))).norm(), 0.1);
}

/// The first frame that has a pose places the map, whatever came before it.
TEST_F(Map3d, GivenPosesThatBeginLaterPlaceAllResults) {
  const auto some = kitchenFrames(folder_, 10);
  if (!some) return;
  ASSERT_EQ(runSwiftlet({"map3d", some->string(), "--out", path("out")}).exit_code, 0);
  const common::Trajectory own = interfaces::readTum(path("out/trajectory.tum"));
  const std::string poses = posesInWorld(own, 3);
  const ProgramEnd seeded =
      runSwiftlet({"map3d", some->string(), "--poses", write("poses.tum", poses), "--out", path("seeded")});
  ASSERT_EQ(seeded.exit_code, 0) << describe(seeded);
  const common::Trajectory in_world = interfaces::readTum(path("seeded/trajectory.tum"));
  ASSERT_EQ(in_world.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    EXPECT_LT((in_world[i].pose.position_m - T_world_own * own[i].pose.position_m).norm(), 0.02) << i;
  EXPECT_LT((middleOfCloud(path("seeded/cloud.ply")) - T_world_own * middleOfCloud(path("out/cloud.ply"))).norm(), 0.1);
  EXPECT_LT((middleOfVoxels(path("seeded/map.bt")) - T_world_own * middleOfVoxels(path("out/map.bt"))).norm(), 0.1);
}

TEST_F(Map3d, SaysWhatGivenPosesCannotBe) {
  const auto some = kitchenFrames(folder_, 45);
  if (!some) return;
  const std::string empty = write("empty.tum", "# t x y z qx qy qz qw\n");
  const ProgramEnd refused = runSwiftlet({"map3d", some->string(), "--poses", empty, "--out", path("out")});
  EXPECT_EQ(refused.exit_code, 2) << describe(refused);
  EXPECT_THAT(refused.err, HasSubstr("empty.tum: holds no poses"));
  ASSERT_EQ(runSwiftlet({"map3d", some->string(), "--out", path("out")}).exit_code, 0);
  std::string millimetres;
  for (common::StampedPose at : interfaces::readTum(path("out/trajectory.tum"))) {
    at.pose.position_m *= 1000.0;
    millimetres += interfaces::toTumLine(at);
  }
  const ProgramEnd end =
      runSwiftlet({"map3d", some->string(), "--poses", write("mm.tum", millimetres), "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("note: the given poses contradict the pictures"));
}

/// As of a survey: the octree of the results ends before it.
TEST_F(Map3d, RefusesPosesFartherThanTheMapReachesBeforeItMaps) {
  const auto some = kitchenFrames(folder_, 3);
  if (!some) return;
  const auto mapWith = [&](const std::string& poses) {
    return runSwiftlet({"map3d", some->string(), "--poses", write("poses.tum", poses), "--out", path("out")});
  };
  const std::string far = " 512345 5412345 100 0 0 0 1\n", near = " 0 0 0 0 0 0 1\n";
  const ProgramEnd refused = mapWith("0" + far + "0.4" + far);
  EXPECT_EQ(refused.exit_code, 2) << describe(refused);
  EXPECT_THAT(refused.err, HasSubstr("poses.tum: places a frame at (512345, 5412345, 100) m, but the map reaches only "
                                     "1633 m from the origin"));
  EXPECT_THAT(refused.err, HasSubstr("are the poses in metres? If so, subtract an offset from all of them"));
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_EQ(mapWith("0" + near + "0.4" + near + "100" + far).exit_code, 0) << "no frame is there";
}

/// A double would keep them to a quarter of a microsecond.
TEST_F(Map3d, TheTrajectoryHasTheStampsOfTheRecordingToTheNanosecond) {
  const auto some = kitchenFrames(folder_, 3);
  if (!some) return;
  std::string list;
  for (int i = 0; i < 3; ++i)
    list += fmt::format("1305031453.{1}59683987 frame-{0:06}.color.jpg 1305031453.{1}59683987 frame-{0:06}.depth.png\n",
                        2 * i, i);
  write("some/associations.txt", list);
  const std::string lens = write("lens.yaml", "depth_units_per_m: 1000\n");
  const ProgramEnd end = runSwiftlet({"map3d", some->string(), "--intrinsics", lens, "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const std::string trajectory = readText(path("out/trajectory.tum"));
  for (int i = 0; i < 3; ++i) EXPECT_THAT(trajectory, HasSubstr(fmt::format("1305031453.{}59683987 ", i)));
}

TEST_F(Map3d, SaysHowDeepTheViewIsWhereMuchIsLost) {
  const auto some = kitchenFrames(folder_, 30);
  if (!some) return;
  const std::string scale = write("scale.yaml", "depth_units_per_m: 12000\n");
  const ProgramEnd end = runSwiftlet({"map3d", some->string(), "--intrinsics", scale, "--out", path("out")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, testing::ContainsRegex("the depths are 0\\.[0-9]+ m in the median at 12000 units a "
                                              "metre: is depth_units_per_m right"));
}

TEST_F(Map3d, NamesTheResultsAfterTheFolderItIsIn) {
  const auto some = kitchenFrames(folder_, 3);
  if (!some) return;
  fs::rename(*some / "frame-000004.color.jpg", *some / "frame-003604.color.jpg");
  fs::rename(*some / "frame-000004.depth.png", *some / "frame-003604.depth.png");
  test_support::ProgramOptions options;
  options.working_folder = some->string();
  const ProgramEnd end = runSwiftlet({"map3d", "."}, options);
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(readText(*some / "some-map3d/report.html"), HasSubstr("<title>3D map of some</title>"));
  EXPECT_THAT(end.out, HasSubstr("note: the longest gap between two frames is 120.1 s, after the one of 0.067 s"));
}

TEST_F(Map3d, ResultsHaveTheFrameNumbersOfARecordingWithoutTimes) {
  const auto some = kitchenFrames(folder_, 4);
  if (!some) return;
  std::string list;
  for (int i = 0; i < 8; i += 2)
    list += fmt::format("{0} frame-{1:06}.color.jpg {0} frame-{1:06}.depth.png\n", 40 + i / 2, i);
  write("some/associations.txt", list);
  const std::string lens = write("lens.yaml", "depth_units_per_m: 1000\n");
  const std::string poses = write("poses.tum", "40 0 0 0 0 0 0 1\n43 0 0 0 0 0 0 1\n");
  const ProgramEnd end =
      runSwiftlet({"map3d", some->string(), "--intrinsics", lens, "--poses", poses, "--out", path("out")});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out,
              HasSubstr("note: the stamps are whole numbers: they are taken for frames, 30 of which are a second"));
  EXPECT_THAT(end.out, HasSubstr("with a pose    4"));
  const auto trajectory = interfaces::readTum(path("out/trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 4u);
  EXPECT_NEAR(trajectory.front().stamp.seconds(), 40.0, 1e-5);
  EXPECT_NEAR(trajectory.back().stamp.seconds(), 43.0, 1e-5);
}

/// Two frames of another place, as of a table that the camera lay on, come first: they are a piece of their own.
TEST_F(Map3d, AFalseStartIsNotTheWholeMap) {
  const auto some = kitchenFrames(folder_, 60, 2);
  if (!some) return;
  const ProgramEnd end = runSwiftlet({"map3d", some->string(), "--out", path("out"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const nlohmann::json figures = nlohmann::json::parse(end.out);
  EXPECT_EQ(figures.at("frames"), 60) << figures.dump(1);
  EXPECT_EQ(figures.at("lost_frames"), 0);
  ASSERT_EQ(figures.at("pieces").size(), 2u);
  EXPECT_EQ(figures.at("pieces")[0].at("frames"), 58) << "the map";
  EXPECT_EQ(figures.at("pieces")[1].at("frames"), 2);
  EXPECT_EQ(figures.at("trusted"), true) << figures.at("trust_reason");
  EXPECT_THAT(figures.at("notes").dump(), HasSubstr("2 frames are in 1 piece that nothing connects to the map"));
  EXPECT_EQ(interfaces::readTum(path("out/trajectory.tum")).size(), 58u);
  const std::string pieces = readText(path("out/pieces.txt"));
  EXPECT_EQ(std::count(pieces.begin(), pieces.end(), '\n'), 61);
  EXPECT_THAT(pieces, testing::EndsWith(" 2\n"));
}

/// As if two recordings were one.
TEST_F(Map3d, AMapOfWhichMuchIsMissingIsNotTrusted) {
  const auto some = kitchenFrames(folder_, 40, 5);
  if (!some) return;
  const ProgramEnd end = runSwiftlet({"map3d", some->string(), "--out", path("out"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const nlohmann::json figures = nlohmann::json::parse(end.out);
  EXPECT_EQ(figures.at("trusted"), false);
  EXPECT_THAT(figures.at("trust_reason"), HasSubstr("5 in 1 piece that nothing connects to the map"));
}

TEST_F(Map3d, SaysWhereGivenPosesAreOfOtherTimes) {
  const auto some = kitchenFrames(folder_, 4);
  if (!some) return;
  const auto notesWith = [&](const std::string& poses) {
    const ProgramEnd end =
        runSwiftlet({"map3d", some->string(), "--poses", write("poses.tum", poses), "--out", path("out"), "--json"});
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return nlohmann::json::parse(end.out).at("notes").dump();
  };
  const std::string there = " 0 0 0 0 0 0 1\n";
  EXPECT_THAT(notesWith("100.0" + there + "101.0" + there),
              HasSubstr("no frame has a pose of its time: the poses are from 100.000 s to 101.000 s, the frames from"));
  EXPECT_THAT(notesWith("0.0" + there + "0.05" + there), HasSubstr("only 1 of 4 frames have a pose of their time"));
}

}  // namespace
}  // namespace swiftlet::commands
