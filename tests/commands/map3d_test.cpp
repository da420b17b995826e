// swiftlet map3d as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interfaces/files/archive.hpp"
#include "interfaces/files/point_cloud.hpp"
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

/// The few first frames of the recorded kitchen, if there are data sets here.
std::optional<fs::path> kitchenFrames(const fs::path& scratch, int frames) {
  const auto archive = test_support::dataSet("03-rgbd/7scenes-redkitchen-a/redkitchen_000-598_step2.tar");
  if (!archive) return std::nullopt;
  const fs::path all = interfaces::unpackInto(scratch, *archive);
  const fs::path some = scratch / "some";
  fs::create_directories(some);
  for (int i = 0; i < 2 * frames; i += 2)
    for (const char* kind : {"color.jpg", "depth.png"}) {
      const std::string name = fmt::format("frame-{:06}.{}", i, kind);
      fs::copy_file(all / name, some / name);
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
  const ProgramEnd end = runSwiftlet({"map3d", some.string(), "--out", path("out"), "--mesh", "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const nlohmann::json figures = nlohmann::json::parse(end.out);
  EXPECT_EQ(figures.at("format"), "7-Scenes");
  EXPECT_EQ(figures.at("frames"), 19);
  EXPECT_EQ(figures.at("skipped_frames"), 1);
  EXPECT_EQ(figures.at("lost_frames"), 0);
  EXPECT_THAT(figures.at("notes").dump(), HasSubstr("frame-000010.depth.png: is cut off"));
  EXPECT_EQ(interfaces::readTum(path("out/trajectory.tum")).size(), 19u);
  EXPECT_GT(fs::file_size(path("out/cloud.ply")), 100'000u);
  EXPECT_GT(interfaces::readCloud(path("out/mesh.ply")).size(), 1'000u) << "the vertices; faces are left out";
  EXPECT_THAT(readText(path("out/report.html")), HasSubstr("<title>3D map of some"));
  // Its own poses as a seed give the same map.
  const ProgramEnd seeded =
      runSwiftlet({"map3d", some.string(), "--poses", path("out/trajectory.tum"), "--out", path("seeded"), "--json"});
  ASSERT_EQ(seeded.exit_code, 0) << describe(seeded);
  EXPECT_EQ(nlohmann::json::parse(seeded.out).at("lost_frames"), 0);
}

}  // namespace
}  // namespace swiftlet::commands
