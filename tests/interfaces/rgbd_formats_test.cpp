// Recordings of RGB-D cameras in the formats of other programs, made here: which images, which camera, which unit, and
// what is said of those that lack something.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/jpeg_encoder.hpp"
#include "common/png_encoder.hpp"
#include "common/random.hpp"
#include "interfaces/files/trajectory_file.hpp"
#include "interfaces/rgbd/camera_files.hpp"
#include "interfaces/rgbd/depth_units.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "tests/interfaces/bag_bytes.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces::rgbd_formats {
namespace {

namespace fs = std::filesystem;
using bag_bytes::u32;
using test_support::HasProblem;
using test_support::problemsOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::string textOf(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

common::Image picture(std::uint64_t seed, int width_px, int height_px) {
  common::RandomStream random(seed, "color");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * width_px * height_px));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  return {width_px, height_px, std::move(bytes)};
}
std::string colorPng(std::uint64_t seed, int width_px = 64, int height_px = 48) {
  return textOf(common::encodePng(picture(seed, width_px, height_px)));
}

/// A slope from `near` to `far`, whose codes are multiples of `step`.
common::DepthCodes slope(int near, int far, int step = 1, int width_px = 64, int height_px = 48) {
  common::DepthCodes depth{width_px, height_px, {}};
  const int count = width_px * height_px;
  for (int i = 0; i < count; ++i)
    depth.codes.push_back(static_cast<std::uint16_t>((near + (far - near) * i / count) / step * step));
  return depth;
}
std::string depthPng(int near, int far, int step = 1, int width_px = 64, int height_px = 48) {
  return textOf(common::encodePng(slope(near, far, step, width_px, height_px)));
}

class RgbdFormats : public test_support::Scratch {
 protected:
  /// Images in two folders, of the numbers 0, 1 and 2, from 1 m to 3 m in millimetres.
  void addImages(const std::string& color = "color", const std::string& depth = "depth") {
    fs::create_directories(folder_ / color);
    fs::create_directories(folder_ / depth);
    for (int i = 0; i < 3; ++i) {
      write(fmt::format("{}/{}.png", color, i), colorPng(static_cast<std::uint64_t>(i)));
      write(fmt::format("{}/{:06}.png", depth, i), depthPng(1000 + i, 3000));
    }
  }
  RgbdListing list() const { return listRgbdFolder(folder_); }
  std::vector<common::Problem> problems() const {
    return problemsOf([&] { (void)list(); });
  }
};

constexpr const char* kOpen3dCamera = R"({"width": 640, "height": 480, "intrinsic_matrix":
    [610.0, 0, 0, 0, 611.0, 0, 318.0, 242.0, 1]})";

TEST_F(RgbdFormats, OfOpen3dHasTheCameraOfItsJson) {
  addImages();
  write("camera_intrinsic.json", kOpen3dCamera);
  RgbdFolder folder(list());
  EXPECT_EQ(folder.listing().format, "Open3D");
  EXPECT_THAT(folder.listing().notes, IsEmpty());
  ASSERT_EQ(folder.listing().pairs.size(), 3u);
  const auto frame = folder.next();
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->camera.fx_px, 61.0, 1e-9);
  EXPECT_NEAR(frame->camera.fy_px, 61.1, 1e-9);
  EXPECT_NEAR(frame->camera.cx_px, 0.1 * 318.5 - 0.5, 1e-9);
  EXPECT_NEAR(static_cast<double>(frame->depth.at(0, 0)), 1.0, 1e-6) << "millimetres";
  EXPECT_NEAR((folder.listing().pairs[1].stamp - folder.listing().pairs[0].stamp).seconds(), 1.0 / 30.0, 1e-6);
}

TEST_F(RgbdFormats, OfOpen3dMaySayItsUnitOrHaveNoCamera) {
  addImages("rgb");
  EXPECT_THAT(list().notes, Contains(HasSubstr("525 px focal length")));
  write("intrinsic.json", R"({"width": 640, "height": 480, "depth_scale": 4000.0,
      "intrinsic_matrix": [600, 0, 0, 0, 600, 0, 320, 240, 1]})");
  EXPECT_EQ(list().calibration.depth_units_per_m, 4000.0);
  EXPECT_EQ(list().calibration.color.fx_px, 600.0);
  const std::string lens = write("lens.yaml", "color: {fx_px: 500}\n");
  EXPECT_EQ(listRgbdFolder(folder_, lens).calibration.color.fx_px, 500.0) << "the user's calibration comes last";
  EXPECT_EQ(listRgbdFolder(folder_, lens).calibration.color.fy_px, 600.0);
}

/// Redwood's recorder numbers both cameras on its own and adds the microseconds.
TEST_F(RgbdFormats, OfRedwoodPairsImagesByTheTimesInTheirNames) {
  fs::create_directories(folder_ / "rgb");
  fs::create_directories(folder_ / "depth");
  for (int i = 0; i < 3; ++i) {
    write(fmt::format("rgb/{:07}-{:012}.png", i + 1, 33'000 * i), colorPng(static_cast<std::uint64_t>(i)));
    write(fmt::format("depth/{:07}-{:012}.png", i + 2, 33'000 * i + 4'000), depthPng(1000, 3000));
  }
  const RgbdListing listing = list();
  ASSERT_EQ(listing.pairs.size(), 3u);
  EXPECT_NEAR(listing.pairs[2].stamp.seconds(), 0.066, 1e-9);
  EXPECT_EQ(listing.pairs[2].depth.filename(), "0000004-000000070000.png");
  EXPECT_EQ(listing.unpaired, 0u);
}

std::string matrix(double f_px, double cx_px, double cy_px, int side) {
  std::string text = fmt::format("{} 0 {}{}\n0 {} {}{}\n0 0 1{}\n", f_px, cx_px, side == 4 ? " 0" : "", f_px, cy_px,
                                 side == 4 ? " 0" : "", side == 4 ? " 0" : "");
  return side == 4 ? text + "0 0 0 1\n" : text;
}

TEST_F(RgbdFormats, OfTsdfFusionIsRegisteredAndHasItsOwnCamera) {
  for (int i = 0; i < 3; ++i) {
    write(fmt::format("frame-{:06}.color.jpg", i),
          textOf(common::encodePng(picture(static_cast<std::uint64_t>(i), 64, 48))));
    write(fmt::format("frame-{:06}.depth.png", i), depthPng(1000, 3000));
  }
  EXPECT_EQ(list().format, "7-Scenes");
  write("camera-intrinsics.txt", matrix(60.0, 31.0, 24.0, 3));
  const RgbdListing listing = list();
  EXPECT_EQ(listing.format, "tsdf-fusion");
  EXPECT_TRUE(listing.calibration.is_registered);
  EXPECT_EQ(listing.calibration.color.fx_px, 60.0);
  EXPECT_EQ(listing.calibration.color.width_px, 64) << "that of its images";
  write("camera-intrinsics.txt", matrix(58.5, 32.0, 24.0, 3));
  EXPECT_EQ(list().format, "tsdf-fusion") << "585 px, but of images of another size";
  write("camera-intrinsics.txt", matrix(585.0, 320.0, 240.0, 3));
  EXPECT_THAT(problems(), HasProblem("camera.other-size", "camera-intrinsics.txt"));
}

/// The images of 7-Scenes come with tsdf-fusion's file of the depth camera; their depths are not registered.
TEST_F(RgbdFormats, OfSevenScenesStaysSoBesideTheFileOfItsDepthCamera) {
  write("frame-000000.color.png", colorPng(1, 640, 480));
  write("frame-000000.depth.png", depthPng(1000, 3000, 1, 640, 480));
  write("camera-intrinsics.txt", matrix(585.0, 320.0, 240.0, 3));
  EXPECT_EQ(list().format, "7-Scenes");
  EXPECT_FALSE(list().calibration.is_registered);
}

TEST_F(RgbdFormats, OfScanNetHasACameraForEachOfItsImages) {
  fs::create_directories(folder_ / "color");
  fs::create_directories(folder_ / "depth");
  fs::create_directories(folder_ / "pose");
  fs::create_directories(folder_ / "intrinsic");
  for (int i = 0; i < 2; ++i) {
    write(fmt::format("color/{}.jpg", i), colorPng(static_cast<std::uint64_t>(i), 130, 96));
    write(fmt::format("depth/{}.png", i), depthPng(1000, 3000));
    write(fmt::format("pose/{}.txt", i), "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  write("intrinsic/intrinsic_depth.txt", matrix(57.0, 32.0, 24.0, 4));
  write("intrinsic/intrinsic_color.txt", matrix(117.0, 65.0, 48.0, 4));
  const std::string identity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  write("intrinsic/extrinsic_color.txt", identity);
  write("intrinsic/extrinsic_depth.txt", "1 0 0 0.03\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  RgbdFolder folder(list());
  EXPECT_EQ(folder.listing().format, "ScanNet");
  EXPECT_FALSE(folder.calibration().is_registered);
  EXPECT_EQ(folder.calibration().depth.fx_px, 57.0);
  EXPECT_EQ(folder.calibration().depth_pose.x_m, 0.03);
  const auto frame = folder.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->camera.width_px, 65) << "no finer than its depths";
  EXPECT_NEAR(frame->camera.fx_px, 58.5, 1e-9);
  EXPECT_EQ(readRecordedPoses(folder_).poses.size(), 2u) << "of the folder pose";
  for (int i = 0; i < 2; ++i) write(fmt::format("color/{}.jpg", i), colorPng(static_cast<std::uint64_t>(i)));
  EXPECT_TRUE(list().calibration.is_registered) << "colours scaled to the depths";
  EXPECT_EQ(list().calibration.color.fx_px, 57.0);
}

TEST_F(RgbdFormats, ARefusalNamesWhatIsMissingOrTorn) {
  EXPECT_THAT(problems(), HasProblem("rgbd.unknown-format", "", "a rosbag 1"));
  fs::create_directories(folder_ / "color");
  EXPECT_THAT(problems(), HasProblem("rgbd.part-missing"));
  fs::create_directories(folder_ / "depth");
  EXPECT_THAT(problems(), HasProblem("rgbd.no-images"));
  write("color/1.png", colorPng(1));
  EXPECT_THAT(problems(), HasProblem("rgbd.no-pair"));
  addImages();
  write("camera_intrinsic.json", R"({"width": 640, "intrinsic_matrix": [1, 2]})");
  EXPECT_THAT(problems(), HasProblem("camera.not-open3d", "camera_intrinsic.json"));
  write("camera_intrinsic.json", "{");
  EXPECT_THAT(problems(), HasProblem("camera.not-open3d"));
  fs::remove(folder_ / "camera_intrinsic.json");
  write("camera-intrinsics.txt", "585 0 320\n0 585 240\n");
  EXPECT_THAT(problems(), HasProblem("camera.matrix-cut"));
  write("camera-intrinsics.txt", "585 0 320\n0 many 240\n0 0 1\n");
  EXPECT_THAT(problems(), HasProblem("text.not-a-number", "camera-intrinsics.txt:2:3"));
  const std::string archive = write("frames.tar", "no bag");
  EXPECT_THAT(problemsOf([&] { (void)listRgbdFolder(archive); }), HasProblem("rgbd.no-folder-or-bag", "frames.tar"));
}

TEST(DepthUnits, AreToldFromTheDepths) {
  const auto units = [](const common::DepthCodes& depth, double usual) { return depthUnitsOf(depth.codes, usual); };
  EXPECT_EQ(units(slope(1000, 4000), 1000.0).per_m, 1000.0);
  EXPECT_EQ(units(slope(1000, 4000), 1000.0).note, "");
  EXPECT_EQ(units(slope(1000, 4000), 5000.0).per_m, 1000.0) << "0.2 m to 0.8 m is no room";
  EXPECT_THAT(units(slope(1000, 4000), 5000.0).note, HasSubstr("taken for 1000 units a metre"));
  EXPECT_EQ(units(slope(10'000, 30'000, 5), 5000.0).per_m, 5000.0);
  EXPECT_EQ(units(slope(10'000, 30'000, 5), 1000.0).per_m, 5000.0) << "10 m to 30 m is no room";
  EXPECT_EQ(units(slope(2'500, 9'000, 5), 1000.0).per_m, 5000.0) << "millimetres stored as 1/5000 m";
  EXPECT_EQ(units(slope(2'500, 9'000, 5), 5000.0).note, "");
  EXPECT_EQ(units(slope(2'000, 9'000), 5000.0).per_m, 5000.0) << "either may be, the usual one stays";
  EXPECT_THAT(units(slope(2'000, 9'000), 5000.0).note, HasSubstr("which is possible too"));
  EXPECT_EQ(depthUnitsOf({0, 0, 65535}, 5000.0).per_m, 5000.0);
}

// --- Bags -----------------------------------------------------------------------------------------------------------

constexpr const char* kImage = "060021388200f6f0f447d0fcd9c64743";
constexpr const char* kCompressed = "8f7a12909da2c9d3332d540a0977563f";
constexpr const char* kInfo = "c9a58c1b0b154e0e6da7578cb991d214";

std::string header(std::uint32_t ms, const std::string& frame) {
  return u32(0) + u32(10 + ms / 1000) + u32(ms % 1000 * 1'000'000) + bag_bytes::text(frame);
}
std::string f64(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return u32(static_cast<std::uint32_t>(bits)) + u32(static_cast<std::uint32_t>(bits >> 32));
}
/// With four bytes of padding a row.
std::string image(std::uint32_t ms, const std::string& frame, const std::string& encoding, std::uint32_t row_bytes,
                  const std::string& pixels) {
  std::string rows;
  for (std::size_t at = 0; at < pixels.size(); at += row_bytes) rows += pixels.substr(at, row_bytes) + "pad.";
  return header(ms, frame) + u32(48) + u32(64) + bag_bytes::text(encoding) + std::string(1, '\0') + u32(row_bytes + 4) +
         bag_bytes::text(rows);
}
std::string compressed(std::uint32_t ms, const std::string& frame, const std::string& format, const std::string& data) {
  return header(ms, frame) + bag_bytes::text(format) + bag_bytes::text(data);
}
std::string info(const std::string& frame, const std::vector<double>& distortion = {0.1, 0, 0, 0, 0}) {
  std::string bytes = header(0, frame) + u32(48) + u32(64) + bag_bytes::text("plumb_bob") +
                      u32(static_cast<std::uint32_t>(distortion.size()));
  for (const double d : distortion) bytes += f64(d);
  for (const double k : {61.0, 0.0, 31.0, 0.0, 62.0, 23.0, 0.0, 0.0, 1.0}) bytes += f64(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) bytes += f64(r);
  for (const double p : {60.0, 0.0, 31.0, 0.0, 0.0, 60.0, 23.0, 0.0, 0.0, 0.0, 1.0, 0.0}) bytes += f64(p);
  return bytes + u32(0) + u32(0) + std::string(17, '\0');
}
std::string rgbBytes(const common::Image& picture, bool blue_first) {
  std::string bytes(picture.rgb.begin(), picture.rgb.end());
  for (std::size_t at = 0; blue_first && at < bytes.size(); at += 3) std::swap(bytes[at], bytes[at + 2]);
  return bytes;
}
std::string shortBytes(const common::DepthCodes& depth) {
  std::string bytes;
  for (const std::uint16_t code : depth.codes) {
    bytes += static_cast<char>(code & 0xff);
    bytes += static_cast<char>(code >> 8);
  }
  return bytes;
}
std::string floatBytes(const common::DepthCodes& depth, float unit_m) {
  std::string bytes;
  for (const std::uint16_t code : depth.codes) bytes += bag_bytes::f32(unit_m * code);
  return bytes;
}

class RgbdBags : public test_support::Scratch {
 protected:
  /// One topic of images and their messages.
  struct Topic {
    std::string name, type, md5;
    std::vector<std::string> messages;
  };
  static std::string bag(const std::vector<Topic>& topics, const std::string& by = "none") {
    std::string records;
    for (std::size_t i = 0; i < topics.size(); ++i)
      records += bag_bytes::connection(static_cast<std::uint32_t>(i), topics[i].name, topics[i].type, topics[i].md5);
    for (std::size_t n = 0; n < 8; ++n)
      for (std::size_t i = 0; i < topics.size(); ++i)
        if (n < topics[i].messages.size())
          records += bag_bytes::message(static_cast<std::uint32_t>(i), 10, topics[i].messages[n]);
    return bag_bytes::begin() + bag_bytes::chunk(records, by);
  }
  static Topic colors(const std::string& frame = "rgb_frame") {
    Topic topic{"/camera/rgb/image_raw", "sensor_msgs/Image", kImage, {}};
    for (std::uint32_t i = 0; i < 3; ++i)
      topic.messages.push_back(image(33 * i, frame, "bgr8", 192, rgbBytes(picture(i, 64, 48), true)));
    return topic;
  }
  static Topic depths(const std::string& encoding, const std::string& frame = "rgb_frame", float unit_m = 1e-3F) {
    Topic topic{"/camera/depth/image_raw", "sensor_msgs/Image", kImage, {}};
    for (std::uint32_t i = 0; i < 3; ++i) {
      const common::DepthCodes codes = slope(1000 + static_cast<int>(i), 3000);
      topic.messages.push_back(encoding == "32FC1" ? image(33 * i + 5, frame, encoding, 256, floatBytes(codes, unit_m))
                                                   : image(33 * i + 5, frame, encoding, 128, shortBytes(codes)));
    }
    return topic;
  }
  static Topic cameras(const std::string& name = "/camera/rgb/camera_info") {
    return {name, "sensor_msgs/CameraInfo", kInfo, {info("rgb_frame")}};
  }
  RgbdFolder open(const std::vector<Topic>& topics, const std::string& by = "none") const {
    return RgbdFolder(listRgbdFolder(write("a.bag", bag(topics, by))));
  }
};

TEST_F(RgbdBags, HaveTheirImagesAndTheirCamera) {
  for (const char* by : {"none", "bz2"}) {
    RgbdFolder folder = open({cameras(), colors(), depths("16UC1")}, by);
    EXPECT_EQ(folder.listing().format, "rosbag, /camera/rgb/image_raw and /camera/depth/image_raw");
    EXPECT_THAT(folder.listing().notes, IsEmpty());
    ASSERT_EQ(folder.listing().pairs.size(), 3u);
    EXPECT_EQ(folder.calibration().color.k1, 0.1) << "of a raw image";
    EXPECT_EQ(folder.calibration().color.fy_px, 62.0);
    int frames = 0;
    while (const auto frame = folder.next()) {
      EXPECT_NEAR(frame->stamps.measured.seconds(), 10.0 + 0.033 * frames, 1e-9);
      EXPECT_NEAR(static_cast<double>(frame->depth.at(32, 24)), 2.01, 0.02);
      ++frames;
    }
    EXPECT_EQ(frames, 3);
  }
}

/// A rectified image has no distortion; its pixels stay as they are.
TEST_F(RgbdBags, OfRectifiedImagesHaveTheCameraWithoutItsDistortion) {
  Topic topic = colors();
  topic.name = "/camera/rgb/image_rect_color";
  RgbdFolder folder = open({cameras(), topic, depths("32FC1")});
  EXPECT_EQ(folder.calibration().color.fx_px, 60.0);
  EXPECT_FALSE(folder.calibration().color.isDistorted());
  const auto frame = folder.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->color.rgb, picture(0, 64, 48).rgb) << "blue first, without the padding";
  EXPECT_NEAR(static_cast<double>(frame->depth.at(0, 0)), 1.0, 2e-4) << "metres";
  RgbdFolder millimetres = open({cameras(), topic, depths("32FC1", "rgb_frame", 1.0F)});
  EXPECT_NEAR(static_cast<double>(millimetres.next()->depth.at(0, 0)), 1.0, 2e-4) << "millimetres where metres belong";
}

TEST_F(RgbdBags, MayBeCompressed) {
  Topic color{"/camera/rgb/image_rect_color/compressed", "sensor_msgs/CompressedImage", kCompressed, {}};
  Topic depth{"/camera/depth_registered/image_raw/compressedDepth", "sensor_msgs/CompressedImage", kCompressed, {}};
  Topic inverse = depth;
  constexpr float kA = 1e4F, kB = -2.0F;
  for (std::uint32_t i = 0; i < 3; ++i) {
    color.messages.push_back(compressed(33 * i, "rgb_frame", "bgr8; png compressed bgr8", colorPng(i)));
    const std::string quantization = u32(0) + bag_bytes::f32(kA) + bag_bytes::f32(kB);
    depth.messages.push_back(
        compressed(33 * i, "depth_frame", "16UC1; compressedDepth", u32(0) + u32(0) + u32(0) + depthPng(1000, 3000)));
    inverse.messages.push_back(
        compressed(33 * i, "depth_frame", "32FC1; compressedDepth png", quantization + depthPng(4998, 4998)));
  }
  RgbdFolder folder = open({cameras(), color, depth});
  EXPECT_EQ(folder.calibration().color.fx_px, 60.0) << "the CameraInfo of the topic that was compressed";
  EXPECT_TRUE(folder.calibration().is_registered) << "by the name of the topic";
  EXPECT_NEAR(static_cast<double>(folder.next()->depth.at(0, 0)), 1.0, 1e-6);
  RgbdFolder metres = open({cameras(), color, inverse});
  EXPECT_NEAR(static_cast<double>(metres.next()->depth.at(0, 0)), kA / 5000.0, 2e-4);
}

TEST_F(RgbdBags, DepthsOfAnotherFrameAreSaid) {
  Topic camera = cameras("/camera/depth/camera_info");
  const RgbdFolder folder = open({cameras(), camera, colors(), depths("16UC1", "depth_frame")});
  EXPECT_FALSE(folder.calibration().is_registered);
  EXPECT_THAT(folder.listing().notes, Contains(HasSubstr("the depths are of the frame depth_frame")));
  const RgbdFolder no_camera = open({colors(), depths("16UC1")});
  EXPECT_THAT(no_camera.listing().notes, Contains(HasSubstr("no CameraInfo belongs to the colours")));
}

/// Registered depths are better than those of the depth camera, colours better than infrared pictures.
TEST_F(RgbdBags, TheBestPairOfTopicsIsTaken) {
  Topic infrared = colors();
  infrared.name = "/camera/ir/image_raw";
  Topic registered = depths("16UC1");
  registered.name = "/camera/depth_registered/image";
  for (std::uint32_t i = 0; i < 3; ++i)
    infrared.messages[i] = image(33 * i, "rgb_frame", "mono8", 64, std::string(64 * 48, '\7'));
  const RgbdFolder folder = open({cameras(), infrared, depths("16UC1", "depth_frame"), registered, colors()});
  EXPECT_EQ(folder.listing().format, "rosbag, /camera/rgb/image_raw and /camera/depth_registered/image");
}

TEST_F(RgbdBags, ARefusalNamesTheTopics) {
  const auto problems = [&](const std::vector<Topic>& topics) { return problemsOf([&] { (void)open(topics); }); };
  EXPECT_THAT(problems({cameras(), colors()}),
              HasProblem("rgbd.bag-without-images", "a.bag", "/camera/rgb/image_raw (sensor_msgs/Image)"));
  Topic late = depths("16UC1");
  for (std::string& message : late.messages) message = image(900, "rgb_frame", "16UC1", 128, shortBytes(slope(1, 2)));
  EXPECT_THAT(problems({cameras(), colors(), late}), HasProblem("rgbd.bag-without-pairs", "a.bag"));
}

TEST_F(RgbdBags, ABagThatIsCutIsReadUpToThere) {
  const std::string whole = bag({cameras(), colors(), depths("16UC1")});
  const std::string file = write("cut.bag", whole.substr(0, whole.size() - 10'000));
  RgbdFolder folder(listRgbdFolder(file));
  EXPECT_THAT(folder.listing().notes, Contains(HasSubstr("damaged")));
  int frames = 0;
  while (folder.next()) ++frames;
  EXPECT_EQ(frames, 2) << "of three";
  for (std::size_t size = 0; size < whole.size(); size += 997) {
    const std::string cut = write("cut.bag", whole.substr(0, size));
    try {
      RgbdFolder some(listRgbdFolder(cut));
      while (some.next()) {}
    } catch (const common::InputError& error) {
      EXPECT_FALSE(error.problems().empty());
    }
  }
}

}  // namespace
}  // namespace swiftlet::interfaces::rgbd_formats
