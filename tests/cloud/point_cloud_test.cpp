// Files of clouds: what PCL reads of ours, what we read of PCL's, and what is refused.
#include "interfaces/clouds/point_cloud.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "common/error.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

using common::SurfacePoint;
using ::testing::HasSubstr;
using PclPoint = pcl::PointXYZRGBNormal;
using PclCloud = pcl::PointCloud<PclPoint>;

std::vector<SurfacePoint> randomPoints(std::size_t count, std::mt19937& random, bool normals = true) {
  std::normal_distribution<float> normal(0.0F, 3.0F);
  std::uniform_int_distribution<int> channel(0, 255);
  std::vector<SurfacePoint> points(count);
  for (SurfacePoint& point : points) {
    point.position_m = {normal(random), normal(random), normal(random)};
    if (normals) point.normal = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    for (std::uint8_t& value : point.rgb) value = static_cast<std::uint8_t>(channel(random));
  }
  return points;
}

void expectSame(const std::vector<SurfacePoint>& points, const std::vector<SurfacePoint>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(points[i].position_m, expected[i].position_m);
    ASSERT_LT((points[i].normal - expected[i].normal).norm(), 1e-5F);
    ASSERT_EQ(points[i].rgb, expected[i].rgb);
  }
}

void expectSame(const PclCloud& cloud, const std::vector<SurfacePoint>& expected) {
  ASSERT_EQ(cloud.size(), expected.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(Eigen::Vector3f(cloud[i].getVector3fMap()), expected[i].position_m);
    ASSERT_EQ(Eigen::Vector3f(cloud[i].getNormalVector3fMap()), expected[i].normal);
    ASSERT_EQ((std::array<std::uint8_t, 3>{cloud[i].r, cloud[i].g, cloud[i].b}), expected[i].rgb);
  }
}

PclCloud pclCloud(const std::vector<SurfacePoint>& points) {
  PclCloud cloud;
  for (const SurfacePoint& point : points) {
    PclPoint next;
    next.getVector3fMap() = point.position_m;
    next.getNormalVector3fMap() = point.normal;
    std::tie(next.r, next.g, next.b) = std::tie(point.rgb[0], point.rgb[1], point.rgb[2]);
    cloud.push_back(next);
  }
  return cloud;
}

class CloudFile : public test_support::Scratch {};

TEST_F(CloudFile, PclReadsWhatIsWritten) {
  std::mt19937 random(1);
  const std::vector<SurfacePoint> points = randomPoints(1000, random);
  ASSERT_TRUE(writeCloud(path("cloud.pcd"), points).has_value());
  ASSERT_TRUE(writeCloud(path("cloud.ply"), points).has_value());
  PclCloud pcd, ply;
  ASSERT_EQ(pcl::io::loadPCDFile(path("cloud.pcd"), pcd), 0);
  expectSame(pcd, points);
  ASSERT_EQ(pcl::io::loadPLYFile(path("cloud.ply"), ply), 0);
  ASSERT_EQ(ply.size(), points.size());
  for (std::size_t i = 0; i < ply.size(); ++i) {
    ASSERT_EQ(Eigen::Vector3f(ply[i].getVector3fMap()), points[i].position_m);
    ASSERT_EQ(ply[i].r, points[i].rgb[0]);
    ASSERT_EQ(ply[i].b, points[i].rgb[2]);
  }
}

TEST_F(CloudFile, WhatPclWritesIsRead) {
  std::mt19937 random(2);
  const std::vector<SurfacePoint> points = randomPoints(2000, random);
  const PclCloud cloud = pclCloud(points);
  ASSERT_EQ(pcl::io::savePCDFileBinary(path("binary.pcd"), cloud), 0);
  ASSERT_EQ(pcl::io::savePCDFileBinaryCompressed(path("compressed.pcd"), cloud), 0);
  ASSERT_EQ(pcl::io::savePLYFileBinary(path("binary.ply"), cloud), 0);
  for (const char* name : {"binary.pcd", "compressed.pcd", "binary.ply"}) {
    SCOPED_TRACE(name);
    expectSame(readCloud(path(name)).points, points);
  }
  ASSERT_EQ(pcl::io::savePCDFileASCII(path("text.pcd"), cloud), 0);
  ASSERT_EQ(pcl::io::savePLYFileASCII(path("text.ply"), cloud), 0);
  for (const char* name : {"text.pcd", "text.ply"}) {
    SCOPED_TRACE(name);
    const std::vector<SurfacePoint> read = readCloud(path(name)).points;
    ASSERT_EQ(read.size(), points.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      ASSERT_LT((read[i].position_m - points[i].position_m).norm(), 1e-4F);
      ASSERT_EQ(read[i].rgb, points[i].rgb);
    }
  }
}

TEST(PointCloudTest, APointSurvivesEitherFormat) {
  std::mt19937 random(3);
  for (const std::size_t count : {0, 1, 777})
    for (const bool normals : {true, false})
      for (const CloudFormat format : {CloudFormat::kPly, CloudFormat::kPcd}) {
        const std::vector<SurfacePoint> points = randomPoints(count, random, normals);
        expectSame(parseCloud(toCloud(points, format), "cloud", format).points, points);
      }
}

/// Files of more than a megabyte are written in pieces.
TEST_F(CloudFile, ALargeCloudSurvivesEitherFormat) {
  std::mt19937 random(4);
  const std::vector<SurfacePoint> points = randomPoints(100'000, random);
  for (const char* name : {"large.ply", "large.pcd"}) {
    ASSERT_TRUE(writeCloud(path(name), points));
    expectSame(readCloud(path(name)).points, points);
  }
}

TEST(PointCloudTest, PlyHasAHeaderAndFifteenBytesAPointWithoutNormals) {
  const std::vector<SurfacePoint> points{{{1.0F, 2.0F, 3.0F}, {0, 0, 0}, {10, 20, 30}},
                                         {{-1.0F, 0.0F, 0.5F}, {0, 0, 0}, {255, 0, 1}}};
  const std::string ply = toCloud(points, CloudFormat::kPly);
  EXPECT_THAT(ply, HasSubstr("format binary_little_endian 1.0\n"));
  EXPECT_THAT(ply, HasSubstr("element vertex 2\n"));
  const std::size_t body = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size() - body, 30u);
  EXPECT_EQ(ply.substr(body, 4), std::string("\0\0\x80\x3f", 4));
  EXPECT_EQ(ply.substr(body + 12, 3), "\x0a\x14\x1e");
}

TEST(PointCloudTest, ACloudWithoutColorsIsWrittenWithoutThem) {
  const std::vector<SurfacePoint> points{{{1.0F, 2.0F, 3.0F}, {0, 0, 1}, common::kUnknownColor}};
  EXPECT_THAT(toCloud(points, CloudFormat::kPly), ::testing::Not(HasSubstr("red")));
  EXPECT_THAT(toCloud(points, CloudFormat::kPcd),
              HasSubstr("FIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\n"));
  for (const CloudFormat format : {CloudFormat::kPly, CloudFormat::kPcd})
    expectSame(parseCloud(toCloud(points, format), "cloud", format).points, points);
}

TEST(PointCloudTest, ReadsWhatOtherToolsWrite) {
  // Columns in another order, doubles, faces after the points, an element before them, Windows line ends.
  const StoredCloud text = parseCloud(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement camera 1\r\nproperty list uchar float view\r\n"
      "element vertex 2\r\nproperty uchar blue\r\nproperty double z\r\nproperty float quality\r\nproperty double y\r\n"
      "property double x\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "2 0.5 0.5\r\n7 3 0.9 2 1\r\n8 +6e0 0.9 5 nan\r\n3 0 1 0\r\n",
      "by hand", CloudFormat::kPly);
  EXPECT_EQ(text.not_finite, 1U);
  const std::vector<SurfacePoint>& ply = text.points;
  ASSERT_EQ(ply.size(), 1U);
  EXPECT_EQ(ply[0].position_m, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(ply[0].rgb, common::kUnknownColor) << "one channel is no colour";
  const auto big = parseCloud(
                       "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty short y\n"
                       "property float z\nend_header\n" +
                           std::string("\x3f\x80\0\0\0\x02\x40\x40\0\0", 10),
                       "big", CloudFormat::kPly)
                       .points;
  ASSERT_EQ(big.size(), 1U);
  EXPECT_EQ(big[0].position_m, Eigen::Vector3f(1, 2, 3));
  const auto pcd = parseCloud(
                       "# .PCD v.7\nVERSION .7\nFIELDS x y z rgb vp\nSIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 "
                       "2\nWIDTH 1\nHEIGHT "
                       "2\n"
                       "VIEWPOINT 0 0 0 1 0 0 0\nDATA ascii\n1 2 3 2.3418052e-38 0 0\n4 5 6 0 1 1\n",
                       "by hand", CloudFormat::kPcd)
                       .points;
  ASSERT_EQ(pcd.size(), 2U);
  EXPECT_EQ(pcd[0].rgb, (std::array<std::uint8_t, 3>{255, 0, 0})) << "0xff0000 as the bits of a float";
}

/// With an alpha of 255, some colours are the bits of a signalling NaN, which a conversion to double would change.
TEST(PointCloudTest, PackedColoursKeepTheirBits) {
  for (const char type : {'F', 'U', 'I'})
    for (const int red : {0x00, 0x7f, 0x80, 0xa5, 0xbf, 0xc0, 0xff}) {
      std::string point(12, '\0');
      point += {'\x03', '\x02', static_cast<char>(red), '\xff'};
      const auto pcd =
          parseCloud(
              fmt::format("FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F {}\nPOINTS 1\nDATA binary\n", type) + point,
              "packed", CloudFormat::kPcd)
              .points;
      const auto ply =
          parseCloud(
              fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                          "property float z\nproperty {} rgb\nend_header\n",
                          type == 'F'   ? "float"
                          : type == 'U' ? "uint"
                                        : "int") +
                  point,
              "packed", CloudFormat::kPly)
              .points;
      for (const auto& cloud : {pcd, ply}) {
        ASSERT_EQ(cloud.size(), 1U);
        EXPECT_EQ(cloud[0].rgb, (std::array<std::uint8_t, 3>{static_cast<std::uint8_t>(red), 2, 3})) << type;
      }
    }
}

/// By a problem that names the line in text and the byte in binary.
void expectRefused(const std::string& bytes, CloudFormat format, const std::string& name,
                   const std::string& place = "") {
  const auto problems = test_support::problemsOf([&] { parseCloud(bytes, "broken", format); });
  ASSERT_THAT(problems, testing::ElementsAre(test_support::ProblemIs(name, place))) << bytes.substr(0, 100);
  EXPECT_THAT(test_support::placeOf(problems[0]), testing::ContainsRegex("^broken:( byte )?[0-9]+$"));
}

TEST(PointCloudTest, SaysWhatIsWrong) {
  const auto ply = [](const std::string& bytes, const std::string& name, const std::string& place = "") {
    expectRefused(bytes, CloudFormat::kPly, name, place);
  };
  const auto pcd = [](const std::string& bytes, const std::string& name) {
    expectRefused(bytes, CloudFormat::kPcd, name);
  };
  ply("", "cloud.header-open");
  ply("hello\n", "ply.other-begin");
  ply("ply\nend_header\n", "ply.format-missing");
  ply("ply\nformat ascii 1.0\nend_header\n", "ply.no-vertex");
  ply("ply\nformat morse 1.0\n", "ply.no-format");
  ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "cloud.no-position");
  for (const std::string count : {"-1", "abc", "1e3", "+4", "4.0", "99999999999999999999"})
    ply("ply\nformat ascii 1.0\nelement vertex " + count + "\n", "cloud.no-count", "broken:3");
  ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n", "ply.no-type");
  ply("ply\nformat ascii 1.0\nproperty float x\n", "ply.header-line");
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  ply("ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "1 2 3\n4 5", "cloud.cut-in-row", "broken:9");
  ply("ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "1 2 three\n4 5 6\n", "text.not-a-number", "broken:8");
  ply("ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "1 2 3,5\n4 5 6\n", "text.not-a-number", "broken:8");
  ply("ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\n" + xyz + "1234", "cloud.cut");
  ply("ply\nformat ascii 1.0\nelement nothing 99999999999999\nelement vertex 1\n" + xyz, "ply.no-properties");
  ply("ply\nformat ascii 1.0\nelement list 1\nproperty list int int a\nelement vertex 1\n" + xyz + "-3\n",
      "ply.list-size");
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  pcd("", "cloud.header-open");
  pcd("P6\n", "pcd.header-line");
  pcd("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "pcd.word-counts");
  pcd("FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n", "cloud.no-position");
  pcd("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "pcd.no-type");
  pcd(head + "DATA ascii\n", "pcd.no-points");
  pcd(head + "WIDTH 9999999999999\nHEIGHT 9999999999999\nDATA ascii\n", "pcd.no-points");
  pcd(head + "WIDTH 2\nHEIGHT 3\nPOINTS 2\nDATA ascii\n", "pcd.contradiction");
  pcd(head + "POINTS 1\nDATA zip\n", "pcd.no-data-kind");
  pcd(head + "POINTS 9999999999\nDATA binary\n0123456789", "cloud.cut");
  pcd(head + "POINTS 1\nDATA binary_compressed\n" + std::string("\3\0\0\0\14\0\0\0abc", 11), "pcd.packed-reference");
  pcd(head + "POINTS 357913941\nDATA binary_compressed\n" + std::string("\3\0\0\0\374\377\377\377abc", 11),
      "pcd.packed-fewer");
  pcd(head + "POINTS 1\nDATA binary_compressed\n" + std::string("\2\0\0\0\14\0\0\0\xff\x01", 10), "pcd.packed-cut");
  // So many rows of 12 bytes are 12 bytes in arithmetic of 64 bits.
  pcd(head + "POINTS 4611686018427387905\nDATA binary_compressed\n" + std::string("\14\0\0\0\14\0\0\0abcdefghijkl", 20),
      "pcd.packed-count");
}

/// Read as one stream of numbers, such rows would become points at wrong places.
TEST(PointCloudTest, RowsOfTextHaveAsManyNumbersAsTheHeaderNames) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n";
  for (const auto& [head, format, first] :
       {std::tuple{ply, CloudFormat::kPly, 8}, std::tuple{pcd, CloudFormat::kPcd, 6}}) {
    expectRefused(head + "1 2 3\n4 5 6 7\n", format, "cloud.more-numbers", fmt::format("broken:{}", first + 1));
    expectRefused(head + "1 2\n3 4\n5 6\n", format, "cloud.fewer-numbers", fmt::format("broken:{}", first));
    EXPECT_EQ(parseCloud(head + "\n1 2 3 \r\n\n 4\t5 6", "blanks", format).points.size(), 2U);
  }
}

TEST(PointCloudTest, TellsByHowMuchCoordinatesWereRounded) {
  const std::string head = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 1\nDATA ascii\n";
  EXPECT_EQ(parseCloud(head + "0.5 2 3\n", "near", CloudFormat::kPcd).rounding_m, 0.0);
  EXPECT_NEAR(parseCloud(head + "5412345.1 2 3\n", "far", CloudFormat::kPcd).rounding_m, 0.1, 1e-6);
  EXPECT_EQ(parseCloud(head + "1e300 2 3\n", "beyond", CloudFormat::kPcd).not_finite, 1U);
}

TEST(PointCloudTest, ANumberThatIsTooGreatIsNotFiniteAndOneThatIsTooSmallIsZero) {
  const std::string head = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 1\nDATA ascii\n";
  for (const char* great : {"1e400", "-1e400", "+1e400"}) {
    const StoredCloud cloud = parseCloud(head + great + " 2 3\n", "great", CloudFormat::kPcd);
    EXPECT_EQ(cloud.not_finite, 1U) << great;
    EXPECT_TRUE(cloud.points.empty()) << great;
  }
  const StoredCloud small = parseCloud(head + "1e-400 2 3\n", "small", CloudFormat::kPcd);
  ASSERT_EQ(small.points.size(), 1U);
  EXPECT_EQ(small.points[0].position_m, Eigen::Vector3f(0, 2, 3));
}

TEST(PointCloudTest, OfAFieldOfPcdWithSeveralNumbersTheFirstCounts) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 2 1 1\nPOINTS 1\nDATA ";
  std::string binary(16, '\0');
  const std::array<float, 4> row{1.0F, 9.0F, 2.0F, 3.0F};
  std::memcpy(binary.data(), row.data(), binary.size());
  for (const std::string& bytes : {head + "ascii\n1 9 2 3\n", head + "binary\n" + binary}) {
    const std::vector<SurfacePoint> points = parseCloud(bytes, "several", CloudFormat::kPcd).points;
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].position_m, Eigen::Vector3f(1, 2, 3));
  }
}

TEST_F(CloudFile, OfAnotherNameIsRefused) {
  EXPECT_THROW(readCloud(write("cloud.obj", toCloud({}, CloudFormat::kPly))), common::InputError);
  EXPECT_THROW(readCloud(write("cloud.gz", toCloud({}, CloudFormat::kPly))), common::InputError);
}

TEST(PointCloudTest, AnythingCutOrChangedIsRefusedOrRead) {
  std::mt19937 random(4);
  const std::vector<SurfacePoint> points = randomPoints(20, random);
  for (const CloudFormat format : {CloudFormat::kPly, CloudFormat::kPcd}) {
    const std::string whole = toCloud(points, format);
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_THROW(parseCloud(whole.substr(0, size), "cut", format), common::InputError) << size;
    for (int i = 0; i < 3000; ++i) {
      std::string changed = whole;
      changed[random() % changed.size()] = static_cast<char>(random());
      try {
        parseCloud(changed, "changed", format);
      } catch (const common::InputError&) {
        // Refused: as good.
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet::interfaces
