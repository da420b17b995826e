// Folders of recorded RGB-D frames, and every way in which they can be damaged: skipped, counted, said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/png_encoder.hpp"
#include "common/random.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using test_support::HasProblem;
using testing::HasSubstr;

constexpr int kWidth_px = 64, kHeight_px = 48;

std::string textOf(const std::vector<std::uint8_t>& png) { return {png.begin(), png.end()}; }

std::string colorPng(std::uint64_t seed, int width_px = kWidth_px, int height_px = kHeight_px) {
  common::RandomStream random(seed, "color");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * width_px * height_px));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  return textOf(common::encodePng(common::Image{width_px, height_px, std::move(bytes)}));
}
std::string plainPng(std::uint8_t value) {
  return textOf(common::encodePng(
      common::Image{kWidth_px, kHeight_px, std::vector<std::uint8_t>(std::size_t{3} * kWidth_px * kHeight_px, value)}));
}
std::string depthPng(int code, int width_px = kWidth_px, int height_px = kHeight_px) {
  const auto pixels = static_cast<std::size_t>(width_px * height_px);
  return textOf(common::encodePng(
      common::DepthCodes{width_px, height_px, std::vector<std::uint16_t>(pixels, static_cast<std::uint16_t>(code))}));
}

class RgbdFolders : public test_support::Scratch {
 protected:
  void SetUp() override {
    Scratch::SetUp();
    fs::create_directories(folder_ / "rgb");
    fs::create_directories(folder_ / "depth");
  }
  /// A frame of TUM's format, with its lines in the lists.
  void addFrame(double stamp_s, const std::string& color, const std::string& depth, double depth_later_s = 0.005) {
    const std::string name = fmt::format("{:.6f}.png", stamp_s);
    if (!color.empty()) write("rgb/" + name, color);
    if (!depth.empty()) write("depth/" + name, depth);
    colors_ += fmt::format("{:.6f} rgb/{}\n", stamp_s, name);
    depths_ += fmt::format("{:.6f} depth/{}\n", stamp_s + depth_later_s, name);
    write("rgb.txt", colors_);
    write("depth.txt", depths_);
  }
  RgbdFolder open() const { return RgbdFolder(listRgbdFolder(folder_)); }
  static int countFrames(RgbdFolder& folder) {
    int count = 0;
    while (folder.next()) ++count;
    return count;
  }
  std::string colors_ = "# color images\n", depths_ = "# depth maps\n";
};

TEST_F(RgbdFolders, ReadsTumInMetresInTheOrderOfTheStamps) {
  addFrame(2.0, colorPng(2), depthPng(10'000));
  addFrame(1.0, colorPng(1), depthPng(5'000));
  RgbdFolder folder = open();
  const auto first = folder.next(), second = folder.next();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(folder.next());
  EXPECT_EQ(first->stamps.measured, common::Time::fromSeconds(1.0));
  EXPECT_FLOAT_EQ(first->depth.at(10, 10), 1.0F);
  EXPECT_FLOAT_EQ(second->depth.at(10, 10), 2.0F);
  // The benchmark's intrinsics, at a tenth of the resolution.
  EXPECT_NEAR(first->camera.fx_px, 52.5, 1e-9);
  EXPECT_NEAR(first->camera.cx_px, 31.5, 1e-9);
  EXPECT_EQ(folder.skipped(), 0u);
}

TEST_F(RgbdFolders, CountsWhatCannotBeUsedByItsReason) {
  addFrame(1.0, colorPng(1), depthPng(5'000));
  addFrame(2.0, "", depthPng(5'000));
  addFrame(3.0, colorPng(3), depthPng(5'000).substr(0, 60));
  addFrame(4.0, colorPng(4, 64, 64), depthPng(5'000, 64, 64));
  addFrame(5.0, colorPng(5), depthPng(5'000, 32, 24));
  addFrame(6.0, colorPng(6), depthPng(0));
  addFrame(7.0, colorPng(7), depthPng(250));
  addFrame(8.0, plainPng(1), depthPng(5'000));
  addFrame(9.0, plainPng(255), depthPng(5'000));
  addFrame(10.0, colorPng(10), depthPng(5'000));
  addFrame(11.0, colorPng(10), depthPng(5'000));
  addFrame(12.0, "no image", depthPng(5'000));
  addFrame(13.0, colorPng(13), colorPng(13));
  RgbdFolder folder = open();
  EXPECT_EQ(countFrames(folder), 2);
  const std::map<FrameFault, std::uint64_t> expected{
      {FrameFault::kMissing, 1}, {FrameFault::kUnreadable, 3}, {FrameFault::kOtherSize, 2},
      {FrameFault::kNoDepth, 1}, {FrameFault::kOtherScale, 1}, {FrameFault::kBlack, 1},
      {FrameFault::kWhite, 1},   {FrameFault::kRepeated, 1},   {FrameFault::kStampRepeated, 0}};
  for (const auto& [fault, count] : expected) EXPECT_EQ(folder.skipped(fault), count) << toString(fault);
  EXPECT_THAT(folder.firstDetail(FrameFault::kUnreadable), HasSubstr("3.000000.png: "));
  EXPECT_THAT(folder.firstDetail(FrameFault::kOtherSize), HasSubstr("64x64, its depth 64x64, the calibration 640x480"));
}

TEST_F(RgbdFolders, StampsThatDoNotPairAreCounted) {
  addFrame(1.0, colorPng(1), depthPng(5'000));
  addFrame(2.0, colorPng(2), depthPng(5'000), 0.1);
  RgbdFolder folder = open();
  EXPECT_EQ(countFrames(folder), 1);
  EXPECT_EQ(folder.listing().unpaired, 2u);
}

TEST_F(RgbdFolders, AssociationsMayHaveTheDepthFirst) {
  const std::string whole = (folder_ / "depth_camera").string();
  for (const auto& [color, depth] : std::map<std::string, std::string>{{"rgb/1.png", "depth/1.png"},
                                                                       {"./rgb/1.png", "./depth/1.png"},
                                                                       {whole + "/rgb/1.png", whole + "/depth/1.png"},
                                                                       {"1.color.png", "1.depth.png"}}) {
    for (const bool depth_first : {false, true}) {
      write("associations.txt", depth_first ? fmt::format("1.01 {} 1.0 {}\n", depth, color)
                                            : fmt::format("1.0 {} 1.01 {}\n", color, depth));
      const RgbdListing listing = listRgbdFolder(folder_);
      ASSERT_EQ(listing.pairs.size(), 1u);
      EXPECT_EQ(listing.pairs[0].color, folder_ / color) << depth_first;
      EXPECT_EQ(listing.pairs[0].depth, folder_ / depth) << depth_first;
      EXPECT_EQ(listing.pairs[0].stamp, common::Time::fromSeconds(1.0)) << "that of the colour image";
    }
  }
}

/// As ICL-NUIM has them.
TEST_F(RgbdFolders, FrameNumbersForStampsAreFramesOfACameraAt30Hz) {
  write("associations.txt", "7 depth/7.png 7 rgb/7.png\n8 depth/8.png 8 rgb/8.png\n10 depth/10.png 10 rgb/10.png\n");
  const RgbdListing listing = listRgbdFolder(folder_);
  ASSERT_EQ(listing.pairs.size(), 3u);
  EXPECT_EQ(listing.stamps_per_s, 30.0);
  EXPECT_NEAR((listing.pairs[2].stamp - listing.pairs[0].stamp).seconds(), 0.1, 1e-8);
  for (const char* times : {"7 a 7 b\n8 a 8 b\n", "7 a 7 b\n8 a 8 b\n9.5 a 9.5 b\n", "7 a 7 b\n9 a 9 b\n11 a 11 b\n"}) {
    write("associations.txt", times);
    EXPECT_EQ(listRgbdFolder(folder_).stamps_per_s, 1.0) << times;
  }
}

TEST_F(RgbdFolders, EachDepthImageBelongsToTheNearestColour) {
  addFrame(1.0, colorPng(1), depthPng(5'000), 0.015);
  addFrame(1.018, colorPng(2), depthPng(6'000), 0.5);
  RgbdFolder folder = open();
  const auto frame = folder.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamps.measured, common::Time::fromSeconds(1.018));
  EXPECT_FALSE(folder.next());
}

TEST_F(RgbdFolders, ReadsSevenScenesWithItsDepthRegistered) {
  for (const int number : {0, 2}) {
    write(fmt::format("frame-{:06}.color.png", number), colorPng(static_cast<std::uint64_t>(number)));
    write(fmt::format("frame-{:06}.depth.png", number), depthPng(number == 0 ? 2'000 : 65'535));
  }
  write("frame-000004.color.png", colorPng(4));
  RgbdFolder folder = open();
  EXPECT_EQ(folder.listing().format, "7-Scenes");
  EXPECT_EQ(folder.listing().unpaired, 1u);
  const auto frame = folder.next();
  ASSERT_TRUE(frame);
  // A wall across the view stays one, 2 mm and a turn of half a degree aside; the borders see nothing.
  EXPECT_NEAR(static_cast<double>(frame->depth.at(32, 24)), 2.0, 0.02);
  EXPECT_FALSE(folder.next());
  EXPECT_EQ(folder.skipped(FrameFault::kNoDepth), 1u);
}

/// What a calibration leaves out stays that of the format: TUM stores 5000 a metre, 7-Scenes an unregistered depth.
TEST_F(RgbdFolders, ACalibrationIsReadOverThatOfTheFormat) {
  const std::string lens = write("lens.yaml", "color: {fx_px: 500}\n");
  addFrame(1.0, colorPng(1), depthPng(5'000));
  RgbdFolder tum(listRgbdFolder(folder_, lens));
  const auto frame = tum.next();
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->camera.fx_px, 50.0, 1e-9);
  EXPECT_FLOAT_EQ(frame->depth.at(10, 10), 1.0F);

  fs::create_directories(folder_ / "scene");
  write("scene/frame-000000.color.png", colorPng(1));
  write("scene/frame-000000.depth.png", depthPng(2'000));
  const RgbdCalibration scene = listRgbdFolder(folder_ / "scene", lens).calibration;
  EXPECT_FALSE(scene.is_registered);
  EXPECT_EQ(scene.depth.fx_px, 585.0);
  EXPECT_EQ(scene.color.fx_px, 500.0);
  EXPECT_EQ(scene.color.cx_px, sevenScenesCalibration().color.cx_px);
}

TEST_F(RgbdFolders, NamesTheLineOfAListThatCannotBeRead) {
  const auto problems = [&] { return test_support::problemsOf([&] { open(); }); };
  EXPECT_THAT(problems(), HasProblem("rgbd.no-images")) << "folders of images without any";
  write("depth.txt", "1.0 depth/1.png\n");
  write("rgb.txt", "# color\n1.0 rgb/1.png\nsoon rgb/2.png\n");
  EXPECT_THAT(problems(), HasProblem("text.not-a-time", "rgb.txt:3:1: stamp"));
  write("rgb.txt", "1600000000000000000 rgb/1.png\n");
  EXPECT_THAT(problems(), HasProblem("text.not-a-time", "rgb.txt:1:1: stamp", "1e9"));
  write("rgb.txt", "0 rgb/1.png\n33333 rgb/2.png\n66666 rgb/3.png\n");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-pair", "", "1e6"));
  write("rgb.txt", "1.0\n");
  EXPECT_THAT(problems(), HasProblem("rgbd.word-count", "rgb.txt:1"));
  write("rgb.txt", "9.0 rgb/1.png\n");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-pair", "", "8.000 s"));
  write("rgb.txt", "# none\n");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-pair"));
  write("associations.txt", "1.0 rgb/1.png 1.5 depth/1.png\n1.0 rgb/2.png 3.0 depth/2.png\n");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-pair", "", "0.500 s"));
  write("associations.txt", "");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-images"));
}

TEST(RgbdListings, OfAFolderThatCannotBeReadNameItWithTheReason) {
  const std::string folder(5000, 'x');
  EXPECT_THAT(test_support::problemsOf([&] { (void)listRgbdFolder(folder); }), HasProblem("file.not-reached", folder));
}

TEST(ImageDecoder, NoCutAndNoFlippedByteCrashes) {
  const std::string color = colorPng(1), depth = depthPng(3'000);
  common::RandomStream random(1, "damage");
  for (int i = 0; i < 2'000; ++i) {
    std::string damaged = i % 2 == 0 ? color : depth;
    damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(damaged.size()))] ^=
        static_cast<char>(1 << (i % 8));
    damaged.resize(static_cast<std::size_t>(random.uniform(0.5, 1.0) * static_cast<double>(damaged.size())));
    (void)common::decodeColor(damaged);
    EXPECT_FALSE(common::decodeDepth(damaged).has_value());
  }
}

}  // namespace
}  // namespace swiftlet::interfaces
