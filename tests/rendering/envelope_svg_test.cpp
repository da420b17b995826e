// The picture of an envelope.
#include "rendering/envelope_svg.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet::rendering {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

EnvelopeBar bar(const std::string& name, double acceptable, std::optional<double> fails) {
  return {name, 0.7, true, acceptable, fails, "60 ms", "69 ms", "", "80 ms: crash"};
}

std::string envelopeWith(const EnvelopeBar& one) { return envelopeSvg({"What fails first", "real", "harsh", {one}}); }

/// The rectangle of the bar itself; the legend shows the colours, too.
std::string rectangleOf(const std::string& color) { return "<rect class=\"" + color + "\" x=\"210.0\" y=\"77.0\""; }

TEST(EnvelopeSvgTest, TheColourSaysWithinWhatItFails) {
  EXPECT_THAT(envelopeWith(bar("lag", 0.5, 0.6)), HasSubstr(rectangleOf("bad")));
  EXPECT_THAT(envelopeWith(bar("lag", 0.7, 0.9)), HasSubstr(rectangleOf("poor")));
  EXPECT_THAT(envelopeWith(bar("lag", 0.9, 1.1)), HasSubstr(rectangleOf("good")));
  EXPECT_THAT(envelopeWith(bar("lag", 0.5, std::nullopt)), HasSubstr(rectangleOf("good")));
}

TEST(EnvelopeSvgTest, OnlyWhatFailedHasAnEnd) {
  EXPECT_THAT(envelopeWith(bar("lag", 2.0, 2.2)), HasSubstr("class=\"fails\""));
  EXPECT_THAT(envelopeWith(bar("lag", 2.0, std::nullopt)), Not(HasSubstr("class=\"fails\"")));
  EXPECT_THAT(envelopeWith(bar("lag", 5.0, 6.0)), Not(HasSubstr("class=\"fails\""))) << "beyond the axis";
}

TEST(EnvelopeSvgTest, WhatNoNatureDrawsIsMarked) {
  EnvelopeBar one = bar("late <setpoints>", 1.0, 1.5);
  one.outer = false;
  EXPECT_THAT(envelopeWith(one), HasSubstr("late &lt;setpoints&gt; *"));
  EXPECT_THAT(envelopeWith(one), HasSubstr("not drawn by harsh"));
  EXPECT_THAT(envelopeWith(bar("lag", 1.0, 1.5)), Not(HasSubstr("not drawn by harsh")));
}

TEST(EnvelopeSvgTest, WritesAPictureToLookAt) {
  EnvelopeBar unknown = bar("late setpoints", 2.0, 2.3);
  unknown.inner.reset();
  unknown.outer = false;
  std::ofstream(std::string(SWIFTLET_BINARY_DIR) + "/envelope.svg")
      << envelopeSvg({"What fails first: unb_case1",
                      "real",
                      "harsh",
                      {bar("charge at the start", 0.55, 0.62), bar("motor lag", 0.8, 0.95), bar("gusts", 1.4, 1.6),
                       unknown, bar("jitter of scans", 3.0, 4.4), bar("vibration", 4.5, 4.6),
                       bar("mixed pixels at edges", 1.33, std::nullopt)}});
}

}  // namespace
}  // namespace swiftlet::rendering
