// Clouds as other tools write them: names in any case, colours in other ranges, old and contradictory headers.
#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Rgb = std::array<std::uint8_t, 3>;

StoredCloud ply(const std::string& bytes) { return parseCloud(bytes, "foreign", CloudFormat::kPly); }
StoredCloud pcd(const std::string& bytes) { return parseCloud(bytes, "foreign", CloudFormat::kPcd); }

/// A .ply in text with columns x, y, z and three channels of that type.
StoredCloud colored(const std::string& type, const std::vector<std::string>& colors,
                    const std::array<std::string, 3>& names = {"red", "green", "blue"}) {
  std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\n", colors.size());
  for (const char* name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  for (const std::string& name : names) text += fmt::format("property {} {}\n", type, name);
  text += "end_header\n";
  for (const std::string& color : colors) text += "1 2 3 " + color + "\n";
  return ply(text);
}

TEST(ForeignColours, OfAnyRangeAreRead) {
  struct Case {
    std::string type, first, second;
    Rgb expected;
    bool noted;
  };
  for (const Case& of : std::vector<Case>{{"uchar", "255 128 0", "1 1 1", {255, 128, 0}, false},
                                          {"char", "-1 -128 0", "1 1 1", {255, 128, 0}, false},
                                          {"ushort", "65535 32768 0", "257 0 0", {255, 128, 0}, true},
                                          {"ushort", "255 128 0", "1 1 1", {255, 128, 0}, true},
                                          {"int", "255 128 0", "0 0 0", {255, 128, 0}, true},
                                          {"uint", "65535 32768 0", "0 0 0", {255, 128, 0}, true},
                                          {"float", "1 0.5 0", "0 0 0", {255, 128, 0}, false},
                                          {"float", "1.0001 0.5 -0.0001", "0 0 0", {255, 128, 0}, true},
                                          {"float", "255 128 0", "0 0 0", {255, 128, 0}, true},
                                          {"double", "65535 32768 0", "0 0 0", {255, 128, 0}, true},
                                          {"int", "256 128 0", "0 0 0", {255, 128, 0}, true},
                                          {"double", "1 nan 0", "1 0 0", common::kUnknownColor, true},
                                          {"float", "1e9 0 0", "0 0 0", common::kUnknownColor, true}}) {
    SCOPED_TRACE(of.type + " " + of.first);
    const StoredCloud cloud = colored(of.type, {of.first, of.second});
    ASSERT_EQ(cloud.points.size(), 2U);
    EXPECT_EQ(cloud.points[0].rgb, of.expected);
    EXPECT_EQ(!cloud.notes.empty(), of.noted);
  }
}

TEST(ForeignColours, BelowZeroOrNotFiniteAreNoted) {
  EXPECT_THAT(colored("float", {"0.5 -0.5 0", "1 0 0"}).notes,
              ElementsAre("colours go down to -0.5: what is below 0 is taken as 0"));
  EXPECT_THAT(colored("float", {"0 -1 -2"}).points[0].rgb, (Rgb{0, 0, 0}));
  EXPECT_THAT(colored("float", {"1 nan 0", "1 inf 0", "1 0 0"}).notes,
              ElementsAre("colours left out: those of 2 points are not finite"));
  EXPECT_THAT(colored("float", {"255 -1 0", "nan 0 0"}).notes,
              ElementsAre("colours go up to 255: they are taken to be from 0 to 255; colours go down to -1: what is "
                          "below 0 is taken as 0; colours left out: those of 1 points are not finite"));
}

/// A channel alone is dark in a bright cloud: the range is that of the cloud.
TEST(ForeignColours, HaveOneRangeInAllChannelsOfAllPoints) {
  const StoredCloud cloud = colored("ushort", {"100 200 0", "0 0 65535"});
  EXPECT_EQ(cloud.points[0].rgb, (Rgb{0, 1, 0}));
  EXPECT_EQ(cloud.points[1].rgb, (Rgb{0, 0, 255}));
}

TEST(ForeignColours, GoByAnyNameInAnyCase) {
  for (const auto& names : std::vector<std::array<std::string, 3>>{{"Red", "Green", "Blue"},
                                                                   {"RED", "GREEN", "BLUE"},
                                                                   {"r", "g", "b"},
                                                                   {"R", "G", "B"},
                                                                   {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                                                   {"Diffuse_Red", "Diffuse_Green", "Diffuse_Blue"}}) {
    const StoredCloud cloud = colored("uchar", {"255 128 0"}, names);
    EXPECT_EQ(cloud.points[0].rgb, (Rgb{255, 128, 0})) << names[0];
    EXPECT_THAT(cloud.notes, IsEmpty()) << names[0];
  }
  // Without the other two, `r` is a range.
  const StoredCloud range = colored("float", {"9 1 1"}, {"r", "theta", "phi"});
  EXPECT_EQ(range.points[0].rgb, common::kUnknownColor);
  EXPECT_THAT(range.notes, ElementsAre("columns left out: r, theta, phi"));
}

TEST(ForeignColours, OfPcdArePackedOrSeparate) {
  const auto colorOf = [](const std::string& fields, const std::string& sizes, const std::string& types,
                          const std::string& values) {
    return pcd(fmt::format("FIELDS x y z {}\nSIZE 4 4 4 {}\nTYPE F F F {}\nPOINTS 1\nDATA ascii\n1 2 3 {}\n", fields,
                           sizes, types, values))
        .points.at(0)
        .rgb;
  };
  const Rgb orange{255, 128, 0};
  EXPECT_EQ(colorOf("rgb", "4", "U", "16744448"), orange);
  EXPECT_EQ(colorOf("RGB", "4", "F", "2.3418052e-38"), (Rgb{255, 0, 0})) << "the bits of a float";
  EXPECT_EQ(colorOf("rgb", "4", "F", "16744448"), orange) << "a whole number in a column of floats";
  EXPECT_EQ(colorOf("rgb", "8", "F", "16744448"), orange);
  EXPECT_EQ(colorOf("rgba", "4", "U", "4294934528"), orange) << "with an alpha of 255";
  EXPECT_EQ(colorOf("rgba", "4", "I", "-32768"), orange) << "the same with a sign";
  EXPECT_EQ(colorOf("rgb", "4", "F", "nan"), common::kUnknownColor);
  EXPECT_EQ(colorOf("rgb", "1", "U", "200"), common::kUnknownColor) << "too small for three channels";
  EXPECT_EQ(colorOf("r g b", "1 1 1", "U U U", "255 128 0"), orange);
  EXPECT_EQ(colorOf("r g b a", "4 4 4 4", "F F F F", "1 0.5 0 1"), orange);
  EXPECT_EQ(colorOf("R G B", "2 2 2", "u u u", "65535 32768 0"), orange);
  EXPECT_EQ(colorOf("intensity", "4", "F", "0.7"), common::kUnknownColor);
}

TEST(ForeignColours, OfAFieldWithThreeNumbersAreChannels) {
  const auto head = [](const std::string& size, const std::string& type, int count, const std::string& data) {
    return fmt::format("FIELDS x y z rgb\nSIZE 4 4 4 {}\nTYPE F F F {}\nCOUNT 1 1 1 {}\nPOINTS 1\nDATA {}\n", size,
                       type, count, data);
  };
  EXPECT_EQ(pcd(head("4", "F", 3, "ascii") + "1 2 3 1 0.5 0\n").points.at(0).rgb, (Rgb{255, 128, 0}));
  EXPECT_EQ(pcd(head("1", "U", 3, "ascii") + "1 2 3 255 128 0\n").points.at(0).rgb, (Rgb{255, 128, 0}));
  EXPECT_EQ(pcd(head("1", "U", 4, "ascii") + "1 2 3 255 128 0 9\n").points.at(0).rgb, (Rgb{255, 128, 0}));
  const std::string row = std::string(12, '\0') + "\xff\x80" + std::string(1, '\0'), sizes("\x0f\0\0\0\x0f\0\0\0", 8);
  EXPECT_EQ(pcd(head("1", "U", 3, "binary") + row).points.at(0).rgb, (Rgb{255, 128, 0}));
  EXPECT_EQ(pcd(head("1", "U", 3, "binary_compressed") + sizes + row).points.at(0).rgb, (Rgb{255, 128, 0}));
}

TEST(ForeignColours, ThatAreNoneAreNamed) {
  const auto notes = [](const std::string& field, const std::string& rows) {
    return pcd(fmt::format("FIELDS x y z rgb\n{}\nPOINTS 3\nDATA ascii\n", field) + rows).notes;
  };
  EXPECT_THAT(notes("SIZE 4 4 4 4\nTYPE F F F F", "1 2 3 nan\n1 2 3 1e-38\nnan nan nan nan\n"),
              ElementsAre(HasSubstr("colours left out: those of 1 points")));
  EXPECT_THAT(notes("SIZE 4 4 4 1\nTYPE F F F U", "1 2 3 7\n1 2 3 8\n1 2 3 9\n"),
              ElementsAre(HasSubstr("colours left out: those of 3 points")));
}

TEST(ForeignPly, MorePointsThanTheHeaderSaysAreNoted) {
  const auto head = [](const char* format, const char* more) {
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "{}end_header\n",
        format, more);
  };
  const std::string note = "points left out: 2 that follow the 1 of the header",
                    faces =
                        "element face 0\n"
                        "property list uchar int vertex_indices\n";
  EXPECT_THAT(ply(head("ascii", "") + "1 2 3\n4 5 6\n7 8 9\n").notes, ElementsAre(note));
  EXPECT_THAT(ply(head("ascii", faces.c_str()) + "1 2 3\n4 5 6\n7 8 9\n").notes, ElementsAre(note));
  EXPECT_THAT(ply(head("binary_big_endian", "") + std::string(36, '\0')).notes, ElementsAre(note));
  EXPECT_THAT(ply(head("binary_little_endian", "") + std::string(13, '\0')).notes, IsEmpty()) << "a line end";
  EXPECT_THAT(ply(head("ascii", "") + "1 2 3\n\n").notes, IsEmpty());
}

TEST(ForeignText, MayHaveLinesThatEndInCarriageReturns) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n1 2 3\n4 5 6\n";
  std::replace(text.begin(), text.end(), '\n', '\r');
  const StoredCloud cloud = ply(text);
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[1].position_m, Eigen::Vector3f(4, 5, 6));
}

TEST(ForeignPly, HeadersMayBeInCapitalsAndHaveAnyOrder) {
  const StoredCloud cloud =
      ply("\xef\xbb\xbfPLY\r\nOBJ_INFO by hand\r\nFormat ASCII 1.0\r\nComment " + std::string(9000, 'c') +
          "\r\nElement Vertex 1\r\ncomment in between\r\nProperty Float32 X\r\nProperty List UChar Int red\r\n"
          "Property Double Z\r\nProperty float Y\r\nproperty int64 label\r\nElement Face 2\r\n"
          "Property List UChar Int vertex_indices\r\nEnd_Header\r\n1 2 7 8 3 2 5\r\n3 0 0 0\r\n3 0 0 0\r\n");
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_EQ(cloud.points[0].position_m, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[0].rgb, common::kUnknownColor) << "a list is no channel";
  EXPECT_THAT(cloud.notes, ElementsAre("columns left out: red, label", "elements left out: 2 of `Face`"));
}

TEST(ForeignPly, OfTwoColumnsOfOneNameTheOneInSmallLettersCounts) {
  const StoredCloud cloud =
      ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty int X\nproperty int Y\nproperty int Z\nproperty double x\n"
          "property double y\nproperty double z\nend_header\n100 200 300 1 2 3\n");
  EXPECT_EQ(cloud.points.at(0).position_m, Eigen::Vector3f(1, 2, 3));
  EXPECT_THAT(cloud.notes, ElementsAre("columns left out: X, Y, Z"));
}

TEST(ForeignPcd, HeadersOfAllVersionsAreRead) {
  for (const std::string head :
       {"# .PCD v.5\nVERSION .5\nCOLUMNS x y z\nPOINTS 2\nDATA ascii\n",
        "COLUMNS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nDATA ascii\n",
        "VERSION .7\nFIELDS X Y Z\nSIZE 8 8 8\nTYPE f f f\nCOUNT 1 1 1\nPOINTS 2\nDATA ASCII\n",
        "version 0.7\ntype F F F\nsize 4 4 4\nfields x y z\nwidth 1\nheight 2\nviewpoint 0 0 0 1.0 0 0 0\n"
        "points 2\ndata Ascii\n"}) {
    SCOPED_TRACE(head);
    const StoredCloud cloud = pcd(head + "1 2 3\n4 5 6\n");
    ASSERT_EQ(cloud.points.size(), 2U);
    EXPECT_EQ(cloud.points[1].position_m, Eigen::Vector3f(4, 5, 6));
    EXPECT_THAT(cloud.notes, IsEmpty());
  }
}

TEST(ForeignPcd, PaddingIsNoColumnAndOtherColumnsAreNamed) {
  const std::string head =
      "FIELDS x y z _ intensity ring _\nSIZE 4 4 4 1 4 2 1\nTYPE F F F U F U U\nCOUNT 1 1 1 4 1 1 10\nPOINTS 1\n"
      "VIEWPOINT 1 2 3 1 0 0 0\nDATA binary\n";
  std::string row(12 + 4 + 4 + 2 + 10, '\x7f');
  for (std::size_t i = 0; i < 3; ++i) {
    const auto bits = std::bit_cast<std::array<char, 4>>(static_cast<float>(i + 1));
    std::copy(bits.begin(), bits.end(), row.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  const StoredCloud cloud = pcd(head + row);
  EXPECT_EQ(cloud.points.at(0).position_m, Eigen::Vector3f(1, 2, 3));
  EXPECT_THAT(cloud.notes,
              ElementsAre(HasSubstr("VIEWPOINT 1 2 3 1 0 0 0 left out"), "columns left out: intensity, ring"));
}

TEST(ForeignPcd, WhereTheHeaderContradictsItselfTheFileDecides) {
  const auto head = [](int width, int height, int points, const char* data) {
    return fmt::format("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH {}\nHEIGHT {}\nPOINTS {}\nDATA {}\n", width, height,
                       points, data);
  };
  const std::string text = "1 2 3\n4 5 6\n", binary(24, '\0');
  for (const auto& [width, points] : {std::pair{5, 2}, std::pair{2, 5}}) {
    for (const StoredCloud& cloud :
         {pcd(head(width, 1, points, "ascii") + text), pcd(head(width, 1, points, "binary") + binary)}) {
      EXPECT_EQ(cloud.points.size(), 2U);
      EXPECT_THAT(cloud.notes, ElementsAre(HasSubstr("the file has 2")));
    }
  }
  EXPECT_THROW(pcd(head(2, 3, 4, "ascii") + text), common::InputError);
  const StoredCloud longer = pcd(head(1, 1, 1, "ascii") + text);
  EXPECT_EQ(longer.points.size(), 1U);
  EXPECT_THAT(longer.notes, ElementsAre("points left out: 1 that follow the 1 of the header"));
}

TEST(ForeignPcd, PointsThatWereStoredInsteadOfCompressedAreRead) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA binary_compressed\n";
  const std::string sizes("\x0c\0\0\0\x0c\0\0\0", 8), point("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
  EXPECT_EQ(pcd(head + sizes + point).points.at(0).position_m, Eigen::Vector3f(1, 2, 3));
  const std::string packed = "\x0b" + point;  // A literal of 12 bytes, which is longer than what it stands for.
  EXPECT_EQ(pcd(head + std::string("\x0d\0\0\0\x0c\0\0\0", 8) + packed).points.at(0).position_m,
            Eigen::Vector3f(1, 2, 3));
}

TEST(ForeignText, OfWindowsHasNumbersOfItsOwnThatAreNotFinite) {
  const StoredCloud cloud =
      pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 4\nDATA ascii\n1.#QNAN 1.#QNAN 1.#QNAN\n-1.#IND 0 0\n"
          "-nan(ind) 0 0\n1 2 3\n");
  EXPECT_EQ(cloud.not_finite, 3U);
  EXPECT_EQ(cloud.points.size(), 1U);
}

TEST(ForeignText, HasNumbersOfOneSignAndNothingBehindThem) {
  const auto x = [](const std::string& word) {
    return pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n" + word + " 0 0\n");
  };
  for (const std::string word : {"1.#INF00", "-1.#IND", "1.#SNAN", "1.#J", "-1.#IO"})
    EXPECT_EQ(x(word).not_finite, 1U) << word;
  EXPECT_EQ(x("+1.5").points.at(0).position_m.x(), 1.5F);
  for (const std::string word : {"1.5#", "7#comment", "1.#", "1.#5", "1#INF", "1.5#QNAN", "+-1.5", "++1", "+"})
    EXPECT_THROW(x(word), common::InputError) << word;
}

TEST(ForeignUnits, AreScaledAroundTheOriginBeforeTheyAreRounded) {
  const std::string text =
      "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 1\nDATA ascii\n512345678.5 5412345678.25 1500\n";
  const StoredCloud far = pcd(text);
  EXPECT_GT(far.rounding_m, 1.0);
  const StoredCloud near = parseCloud(text, "near", CloudFormat::kPcd, {{512345000, 5412345000, 0}, 0.001});
  EXPECT_LT(near.rounding_m, 1e-6);
  EXPECT_TRUE(near.points.at(0).position_m.isApprox(Eigen::Vector3f(0.6785F, 0.67825F, 1.5F)));
}

class ForeignFile : public test_support::Scratch {};

TEST_F(ForeignFile, EndingsMayBeInCapitals) {
  const std::string text = toCloud({}, CloudFormat::kPly);
  for (const char* name : {"CLOUD.PLY", "cloud.Ply"}) EXPECT_NO_THROW(readCloud(write(name, text))) << name;
  EXPECT_EQ(cloudFormatOf("a.PCD"), CloudFormat::kPcd);
}

TEST_F(ForeignFile, TheFieldCasesAreRead) {
  const auto folder = test_support::dataSet("10-field-cases");
  if (!folder) return;
  EXPECT_EQ(readCloud(*folder / "cloud_colour_ranges/rgb16.ply").points.at(0).rgb, (Rgb{255, 128, 0}));
  EXPECT_EQ(readCloud(*folder / "cloud_capitals/UPPER.PLY").points.size(), 9072U);
  EXPECT_EQ(readCloud(*folder / "cloud_capitals/caps_rgb.ply").points.at(0).rgb, (Rgb{255, 0, 0}));
  EXPECT_EQ(readCloud(*folder / "cloud_capitals/caps_xyz.pcd").points.size(), 4941U);
  EXPECT_EQ(readCloud(*folder / "cloud_capitals/type_lower.pcd").points.size(), 4941U);
  const std::vector<common::SurfacePoint> stored = readCloud(*folder / "pcd_stored_lzf/stored_lzf.pcd").points;
  ASSERT_EQ(stored.size(), 9072U);
  EXPECT_TRUE(stored[0].position_m.isApprox(Eigen::Vector3f(0.01F, 0.01F, 0.01F)));
}

}  // namespace
}  // namespace swiftlet::interfaces
