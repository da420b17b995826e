#include "perception/recognition/pattern_template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/png_encoder.hpp"
#include "tests/recognition/pattern_scene.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

std::string_view refusal(GrayImage picture, double width_m) {
  const auto made = PatternTemplate::create("mark", std::move(picture), width_m);
  return made ? "" : made.error().name();
}

TEST(PatternTemplate, WithoutASizeIsRefused) {
  for (const double width_m : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_EQ(refusal(landingMark(64), width_m), "pattern.no-size");
}

TEST(PatternTemplate, WithoutCornersIsRefused) {
  EXPECT_EQ(refusal({64, 64, std::vector<std::uint8_t>(64 * 64, 200)}, 0.5), "pattern.no-corners");
  GrayImage edge{64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) edge.values.push_back(i % 64 < 32 ? 0 : 255);
  EXPECT_EQ(refusal(edge, 0.5), "pattern.no-corners");
}

TEST(PatternTemplate, OfAnImpossibleShapeIsRefused) {
  EXPECT_EQ(refusal({}, 0.5), "pattern.shape");
  EXPECT_EQ(refusal({8, 8, std::vector<std::uint8_t>(64)}, 0.5), "pattern.shape");
  EXPECT_EQ(refusal({64, 64, {}}, 0.5), "pattern.shape");
  EXPECT_EQ(refusal({20, 400, std::vector<std::uint8_t>(8000)}, 0.5), "pattern.shape");
}

TEST(PatternTemplate, IsReadFromAPictureAndFromNothingElse) {
  const GrayImage mark = landingMark(64);
  common::Image image{64, 64, {}};
  for (const std::uint8_t value : mark.values) image.rgb.insert(image.rgb.end(), 3, value);
  const auto png = common::encodePng(image);
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
  const auto read = PatternTemplate::read("mark", bytes, 0.5);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->picture().values, mark.values);
  EXPECT_EQ(PatternTemplate::read("mark", "no picture", 0.5).error().name(), "image.no-png-or-jpeg");
  EXPECT_FALSE(PatternTemplate::read("mark", bytes.substr(0, bytes.size() / 2), 0.5));
}

TEST(PatternTemplate, PixelsAndPlacesOnThePaperAreEachOthersInverse) {
  const auto pattern = PatternTemplate::create("mark", landingMark(64), 0.64);
  ASSERT_TRUE(pattern);
  EXPECT_TRUE(pattern->point_pattern_m({31.5, 31.5}).isZero(1e-12));
  EXPECT_TRUE(pattern->point_pattern_m({63.5, -0.5}).isApprox(Eigen::Vector2d(0.32, 0.32)));
  EXPECT_TRUE(pattern->pixel(pattern->point_pattern_m({3.0, 50.0})).isApprox(Eigen::Vector2d(3.0, 50.0)));
}

}  // namespace
}  // namespace swiftlet::perception
