// The pictures of maps: every kind that map_server takes, and clear words for the others.
#include "interfaces/files/map_picture.hpp"

#include <gmock/gmock.h>

#include "common/jpeg_encoder.hpp"
#include "png_bytes.hpp"
#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::IsEmpty;

common::GreyImage image(const std::string& bytes) { return parsePicture(bytes, "p").image; }
std::vector<std::uint8_t> brightness(const std::string& bytes) { return image(bytes).brightness; }
std::vector<common::Problem> refusalOf(const std::string& bytes) {
  return problemsOf([&] { parsePicture(bytes, "m.pgm"); });
}
std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST(MapPicture, ReadsTextAndBinaryWithAnyGreatestValue) {
  const common::GreyImage text = image("P2 # comment\n2 # another\n2\n15\n0 15\n# third\n7 3\n");
  EXPECT_EQ(text.width_px, 2);
  EXPECT_EQ(text.height_px, 2);
  EXPECT_THAT(text.brightness, ElementsAre(0, 255, 119, 51));
  EXPECT_THAT(text.opacity, IsEmpty());
  EXPECT_THAT(brightness("P5#c\n3 1\n#c\n255\n" + bytes({0, 205, 254})), ElementsAre(0, 205, 254));
  EXPECT_THAT(brightness("P5 2 1 100\n" + bytes({80, 100})), ElementsAre(204, 255));
  EXPECT_THAT(brightness("P5\n3 1\n65535\n" + bytes({0, 0, 205, 205, 254, 254})), ElementsAre(0, 205, 254));
  EXPECT_THAT(brightness("P5 2 1 1023\n" + bytes({3, 255, 0, 0})), ElementsAre(255, 0));
  EXPECT_THAT(brightness("P2 2 1 65535 52685 65535"), ElementsAre(205, 255));
  EXPECT_THAT(brightness("P6 2 1 255\n" + bytes({255, 0, 0, 9, 10, 11})), ElementsAre(85, 10));
  EXPECT_THAT(brightness("P3 1 1 255\n205 205 205\n"), ElementsAre(205));
}

TEST(MapPicture, WhatFollowsTheGreatestValueInItsLineIsNoPixel) {
  const std::string pixels = bytes({1, 2, 3});
  for (const std::string end : {"\r\n", " \n", "\n# a comment\n", "\n# one\n#two\r\n", " # a comment\n", "# c\n"}) {
    const MapPicture picture = parsePicture("P5\r\n3 1\r\n255" + end + pixels, "p");
    EXPECT_THAT(picture.image.brightness, ElementsAre(1, 2, 3)) << end;
    EXPECT_EQ(picture.left_over_bytes, 0u) << end;
  }
  // Pixels may look like a line end or a comment.
  EXPECT_THAT(brightness("P5 3 1 255\n#a\n"), ElementsAre('#', 'a', '\n'));
  EXPECT_THAT(brightness("P5 1 1 255\r\n"), ElementsAre('\n'));
}

TEST(MapPicture, CountsWhatFollowsThePixels) {
  EXPECT_EQ(parsePicture("P5 2 1 255\nab", "p").left_over_bytes, 0u);
  EXPECT_EQ(parsePicture("P5 2 1 255\nab\n", "p").left_over_bytes, 1u);
  EXPECT_EQ(parsePicture("P5 2 1 255\n# c\nab\n\n", "p").left_over_bytes, 2u);
  EXPECT_EQ(parsePicture("P2 2 1 255\n1 2\n", "p").left_over_bytes, 0u);
  EXPECT_EQ(parsePicture("P2 2 1 255\n1 2 34", "p").left_over_bytes, 2u);
  const std::string png = pngOf(3, 1, bytes({0, 205, 254}), {});
  EXPECT_EQ(parsePicture(png, "p").left_over_bytes, 0u);
  EXPECT_EQ(parsePicture(png + "\n", "p").left_over_bytes, 1u);
  EXPECT_EQ(parsePicture(png + png, "p").left_over_bytes, png.size());
}

TEST(MapPicture, ReadsPngOfEveryKind) {
  EXPECT_THAT(brightness(pngOf(3, 1, bytes({0, 205, 254}), {})), ElementsAre(0, 205, 254));
  EXPECT_THAT(brightness(pngOf(8, 1, bytes({0xa0}), {.depth = 1})), ElementsAre(255, 0, 255, 0, 0, 0, 0, 0));
  EXPECT_THAT(brightness(pngOf(2, 1, bytes({205, 205, 254, 254}), {.depth = 16})), ElementsAre(205, 254));
  EXPECT_THAT(brightness(pngOf(2, 1, bytes({255, 0, 0, 9, 10, 11}), {.color_type = 2})), ElementsAre(85, 10));
  EXPECT_THAT(brightness(pngOf(2, 1, bytes({1, 0}), {8, 3, bytes({1, 2, 3, 205, 205, 205})})), ElementsAre(205, 2));
  EXPECT_THAT(brightness(pngOf(2, 2, bytes({0x40}), {2, 3, bytes({9, 9, 9, 7, 7, 7})})), ElementsAre(7, 9, 7, 9));
  const common::GreyImage see_through = image(pngOf(2, 1, bytes({0, 255, 10, 0}), {.color_type = 4}));
  EXPECT_THAT(see_through.brightness, ElementsAre(0, 10));
  EXPECT_THAT(see_through.opacity, ElementsAre(255, 0));
  EXPECT_THAT(image(pngOf(1, 1, bytes({9, 10, 11, 77}), {.color_type = 6})).opacity, ElementsAre(77));
  EXPECT_THAT(image(pngOf(2, 1, bytes({0, 1}), {8, 3, bytes({1, 1, 1, 2, 2, 2}), bytes({0})})).opacity,
              ElementsAre(0, 255));
}

/// A file header and one of 40 bytes or more, then `rest`; `more` follows the first 40.
std::string bmp(int width, int height, int bits, int packing, const std::string& more, const std::string& rest) {
  const auto little = [](std::int64_t value, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  const auto header = static_cast<int>(40 + (packing == 3 && more.size() > 16 ? more.size() : 0));
  const int begin = 14 + 40 + static_cast<int>(more.size());
  return "BM" + little(begin + static_cast<int>(rest.size()), 4) + little(0, 4) + little(begin, 4) + little(header, 4) +
         little(width, 4) + little(height, 4) + little(1, 2) + little(bits, 2) + little(packing, 4) + little(0, 20) +
         more + rest;
}

TEST(MapPicture, ReadsBmpOfEveryDepth) {
  const std::string two_colors = bytes({0, 0, 0, 0, 205, 205, 205, 0});
  EXPECT_THAT(brightness(bmp(3, 1, 1, 0, two_colors, bytes({0x40, 0, 0, 0}))), ElementsAre(0, 205, 0));
  std::string sixteen;
  for (int i = 0; i < 16; ++i) sixteen += bytes({i, i, i, 0});
  EXPECT_THAT(brightness(bmp(3, 1, 4, 0, sixteen, bytes({0x9f, 0x10, 0, 0}))), ElementsAre(9, 15, 1));
  std::string all;
  for (int i = 0; i < 256; ++i) all += bytes({i, i, i, 0});
  EXPECT_THAT(brightness(bmp(2, 1, 8, 0, all, bytes({205, 7, 0, 0}))), ElementsAre(205, 7));
  // The lowest row comes first, and each takes whole words; a negative height says the opposite.
  const std::string rows = bytes({1, 2, 3, 0, 4, 5, 6, 0});
  EXPECT_THAT(brightness(bmp(1, 2, 24, 0, "", rows)), ElementsAre(5, 2));
  EXPECT_THAT(brightness(bmp(1, -2, 24, 0, "", rows)), ElementsAre(2, 5));
  EXPECT_THAT(brightness(bmp(1, 2, 24, 0, "", rows.substr(0, 7))), ElementsAre(5, 2)) << "no padding at the end";
  EXPECT_THAT(brightness(bmp(2, 1, 16, 0, "", bytes({0xff, 0x7f, 0, 0}))), ElementsAre(255, 0));
  const common::GreyImage plain = image(bmp(1, 1, 32, 0, "", bytes({205, 205, 205, 9})));
  EXPECT_THAT(plain.brightness, ElementsAre(205));
  EXPECT_THAT(plain.opacity, IsEmpty()) << "the fourth byte means nothing without masks";
}

TEST(MapPicture, ReadsBmpWithMasks) {
  const std::string of_565 = bytes({0, 0xf8, 0, 0, 0xe0, 7, 0, 0, 0x1f, 0, 0, 0});
  EXPECT_THAT(brightness(bmp(2, 1, 16, 3, of_565, bytes({0xff, 0xff, 0, 0xf8}))), ElementsAre(255, 85));
  const std::string masks = bytes({0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255}) + std::string(68, '\0');
  const common::GreyImage see_through = image(bmp(2, 1, 32, 3, masks, bytes({5, 5, 5, 255, 8, 8, 8, 0})));
  EXPECT_THAT(see_through.brightness, ElementsAre(5, 8));
  EXPECT_THAT(see_through.opacity, ElementsAre(255, 0));
  EXPECT_THAT(image(bmp(1, 1, 32, 3, masks, bytes({5, 5, 5, 0}))).opacity, IsEmpty()) << "nothing would be left";
  const std::string core = "BM" + bytes({0, 0, 0, 0, 0, 0, 0, 0, 26, 0, 0, 0, 12, 0, 0, 0, 1, 0, 1, 0, 1, 0, 24, 0});
  EXPECT_THAT(brightness(core + bytes({7, 8, 9, 0})), ElementsAre(8)) << "of OS/2";
}

TEST(MapPicture, SaysOfWhatIsDamagedThatItIs) {
  EXPECT_THAT(refusalOf(""), ElementsAre(ProblemIs("picture.empty", "m.pgm")));
  for (const std::string page : {"\n<!DOCTYPE html>\n<html>", "<html lang=\"en\">"})
    EXPECT_THAT(refusalOf(page), HasProblem("picture.web-page", "m.pgm"));
  const std::string png = pngOf(3, 1, "abc", {});
  std::string changed = png;
  changed[png.size() - 13] = static_cast<char>(changed[png.size() - 13] ^ 1);  // The sum of the pixels' chunk.
  for (const std::string& damaged : {png.substr(0, 20), png.substr(0, png.size() - 14), changed,
                                     bytes({255, 216, 255, 224}), bmp(9, 9, 24, 0, "", "abc")}) {
    EXPECT_THAT(refusalOf(damaged), HasProblem(kAnyName, "m.pgm", "is damaged: "));
  }
}

TEST(MapPicture, ReportsWhatCannotBeRead) {
  EXPECT_THAT(refusalOf("%PDF"), HasProblem("picture.other-kind", "m.pgm"));
  EXPECT_THAT(refusalOf("GIF89a"), HasProblem("picture.other-kind", "m.pgm", "`convert FILE map.png`"));
  EXPECT_THAT(refusalOf(bmp(1, 1, 8, 1, "", "")), HasProblem("bmp.run-lengths", "m.pgm", "RLE8"));
  EXPECT_THAT(refusalOf(bmp(1, 1, 4, 2, "", "")), HasProblem("bmp.run-lengths", "m.pgm", "RLE4"));
  EXPECT_THAT(refusalOf(bmp(1, 1, 0, 4, "", "")), HasProblem("bmp.other-packing"));
  EXPECT_THAT(refusalOf(bmp(1, 1, 7, 0, "", "")), HasProblem("bmp.other-depth"));
  EXPECT_THAT(refusalOf(bmp(0, 1, 8, 0, "", "")), HasProblem("image.too-large"));
  EXPECT_THAT(refusalOf(bmp(30000, 30000, 24, 0, "", "abc")), HasProblem("bmp.cut"));
  EXPECT_THAT(refusalOf("BM"), HasProblem("bmp.other-header"));
  EXPECT_THAT(refusalOf(pngOf(3, 1, "abc", {}).substr(0, 40)), HasProblem("image.cut-off"));
  std::string vast = pngOf(1, 1, "a", {});
  vast.replace(8, 25, pngChunk("IHDR", bigEndian(32768) + bigEndian(32768) + bytes({8, 6, 0, 0, 0})));
  EXPECT_THAT(refusalOf(vast), HasProblem("image.cut-off"));
}

/// A black picture.
std::string jpeg(int width, int height) {
  const std::vector<std::uint8_t> bytes = common::JpegEncoder().encode(
      {width, height,
       std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))},
      90);
  return {bytes.begin(), bytes.end()};
}

TEST(MapPicture, TellsAWholeJpegThatIsNotReadFromADamagedOne) {
  const std::string good = jpeg(8200, 8);
  EXPECT_EQ(image(good).width_px, 8200) << "as large as a PNG may be";
  EXPECT_THAT(refusalOf(good.substr(0, good.size() - 9)), HasProblem("image.not-decoded", "m.pgm", "is damaged: "));
  const std::size_t frame = good.find("\xff\xc0") + 4;  // The bits of a sample, the height, the width.
  std::string deep = good, wide = good, vast = good;
  deep[frame] = 12;
  EXPECT_THAT(refusalOf(deep), ElementsAre(ProblemIs("image.not-decoded", "m.pgm", "`convert FILE map.png`")));
  wide.replace(frame + 3, 2, "\x9c\x40");
  EXPECT_THAT(refusalOf(wide), HasProblem("image.too-large", "m.pgm"));
  vast.replace(frame + 1, 4, "\x7f\xff\x7f\xff");
  EXPECT_THAT(refusalOf(vast), HasProblem("image.cut-off", "m.pgm", "is damaged: "));
  std::string png = pngOf(1, 1, "a", {});
  png.replace(8, 25, pngChunk("IHDR", bigEndian(2) + bigEndian(40000) + bytes({8, 0, 0, 0, 0})));
  EXPECT_THAT(refusalOf(png), HasProblem("image.too-large", "m.pgm"));
}

TEST(MapPicture, ReportsThePlaceOfMistakes) {
  EXPECT_THAT(refusalOf("P5\n# c\n0 3\n255\n"), HasProblem("netpbm.number", "m.pgm:3: width"));
  EXPECT_THAT(refusalOf("P5\n2\nx\n255\n"), HasProblem("netpbm.number", "m.pgm:3: height"));
  EXPECT_THAT(refusalOf("P5\n2 2\n65536\n"), HasProblem("netpbm.number", "m.pgm:3: greatest value"));
  EXPECT_THAT(refusalOf("P5\n32000 32000\n255\nabc"), HasProblem("netpbm.cut", "m.pgm:3: pixels"));
  EXPECT_THAT(refusalOf("P5\n2 1\n65535\nabc"), HasProblem("netpbm.cut"));
  EXPECT_THAT(refusalOf("P6\n2 1\n255\nabcd"), HasProblem("netpbm.cut"));
  EXPECT_THAT(refusalOf("P2\n2 2\n9\n1 2 3 "), HasProblem("netpbm.cut", "pixels"));
  EXPECT_THAT(refusalOf("P2\n2 2\n9\n1 2\n10 3\n"), HasProblem("netpbm.number", "m.pgm:5: pixel"));
}

// The same floor in four kinds of file.
TEST(MapPicture, ReadsTheFieldCases) {
  const auto folder = test_support::dataSet("10-field-cases");
  if (!folder) return;
  const auto read = [&](const char* name) { return image(bytesOf(*folder / name)); };
  const common::GreyImage base = read("map_extra_keys/base.pgm");
  EXPECT_EQ(read("map_pictures/p16.pgm").brightness, base.brightness);
  EXPECT_EQ(read("map_pictures/pal.png").brightness, base.brightness);
  EXPECT_EQ(read("map_extra_bytes/comment_last.pgm").brightness, base.brightness);
  EXPECT_EQ(read("map_pictures/rgba.png").brightness, base.brightness);
}

}  // namespace
}  // namespace swiftlet::interfaces
