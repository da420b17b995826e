// Depths by stereo against those that rays measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>

#include "common/config.hpp"
#include "pair_rig.hpp"
#include "vision/stereo_matcher.hpp"

namespace swiftlet::vision {
namespace {

using simulation::Pattern;

/// How the depths of a frame differ from the truth.
struct DepthErrors {
  double share_measured = 0.0;  ///< Of the pixels within the sheet's range.
  double share_wrong = 0.0;     ///< Of those measured, by more than 3 px of disparity.
  double median_px = 0.0;       ///< Median absolute error of the disparity.
  double sigma_px = 0.0;        ///< Root mean square of the errors of the disparity that are not wrong.
  std::map<int, double> rms_m;  ///< By whole metres of the true depth.
};

DepthErrors errorsOf(const common::DepthImage& depth, const common::DepthImage& truth,
                     const common::RgbdCameraConfig& sheet) {
  const double focal_base = sheet.camera().fx_px * sheet.baseline_m;
  DepthErrors errors;
  int within = 0, measured = 0, wrong = 0;
  std::vector<double> apart_px;
  std::map<int, std::pair<double, int>> by_metre;
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.depth_m.size(); ++i) {
    const auto true_m = static_cast<double>(truth.depth_m[i]);
    if (!common::isMeasured(truth.depth_m[i]) || true_m < sheet.range_min_m || true_m > sheet.range_max_m) continue;
    ++within;
    if (!common::isMeasured(depth.depth_m[i])) continue;
    ++measured;
    const double error_px = focal_base / static_cast<double>(depth.depth_m[i]) - focal_base / true_m;
    apart_px.push_back(std::abs(error_px));
    if (std::abs(error_px) > 3.0) {
      ++wrong;
      continue;
    }
    sum += error_px * error_px;
    auto& [squares, count] = by_metre[static_cast<int>(true_m)];
    squares += std::pow(static_cast<double>(depth.depth_m[i]) - true_m, 2);
    ++count;
  }
  if (measured == 0) return errors;
  errors.share_measured = static_cast<double>(measured) / within;
  errors.share_wrong = static_cast<double>(wrong) / measured;
  std::nth_element(apart_px.begin(), apart_px.begin() + measured / 2, apart_px.end());
  errors.median_px = apart_px[static_cast<std::size_t>(measured / 2)];
  errors.sigma_px = std::sqrt(sum / std::max(1, measured - wrong));
  for (const auto& [metre, at] : by_metre) errors.rms_m[metre] = std::sqrt(at.first / at.second);
  return errors;
}

class Matched : public testing::TestWithParam<Pattern> {};

TEST_P(Matched, DepthsAreAsExactAsTheySay) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(GetParam()));
  StereoMatcher matcher(sheet);
  for (const double height_m : {0.8, 1.0, 1.5, 2.2}) {
    const auto pose = hovering(height_m, 0.3, 0.2, 0.4);
    const auto frame = matcher.match(rig.taken(pose));
    ASSERT_TRUE(frame) << frame.error().text();
    ASSERT_EQ(frame->depth.depth_m.size(), 376U * 240U);
    EXPECT_FALSE(frame->right);
    const DepthErrors errors = errorsOf(frame->depth, rig.trueDepth(pose), sheet);
    EXPECT_GT(errors.share_measured, 0.25) << height_m;
    EXPECT_LT(errors.share_wrong, 0.02) << height_m;
    EXPECT_LT(errors.sigma_px / (matcher.noise().sigma_per_m2 * sheet.camera().fx_px * sheet.baseline_m), 2.0)
        << height_m;
  }
}
INSTANTIATE_TEST_SUITE_P(StereoMatcher, Matched,
                         testing::Values(Pattern::kCarpet, Pattern::kWood, Pattern::kTiles, Pattern::kBrick));

// The figures of docs/decisions/cameras_and_lasers.md#118 are what it prints.
TEST(StereoMatcher, BlocksAreAsExactAsSemiGlobalMatchingWhereTheyMeasure) {
  for (const int width_px : {376, 752})
    for (const Pattern pattern : {Pattern::kCarpet, Pattern::kWood, Pattern::kPlaster}) {
      const common::RgbdCameraConfig sheet = shippedPair(width_px);
      PairRig rig(sheet, furnishedRoom(pattern));
      const auto pose = hovering(1.5, 0.3, 0.2, 0.4);
      const common::RgbdFrame pair = rig.taken(pose);
      const common::DepthImage truth = rig.trueDepth(pose);
      const auto measured = [&](StereoMethod method) {
        StereoMatcher matcher(sheet, method);
        const std::clock_t begin = std::clock();
        const auto frame = matcher.match(pair);
        const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        EXPECT_TRUE(frame) << frame.error().text();
        const DepthErrors errors = errorsOf(frame->depth, truth, sheet);
        std::printf("%d px, pattern %d, %s: %.1f ms, %.0f %% measured, %.2f %% wrong, rms %.3f px\n", width_px,
                    static_cast<int>(pattern), method == StereoMethod::kBlocks ? "blocks" : "SGBM", ms,
                    100.0 * errors.share_measured, 100.0 * errors.share_wrong, errors.sigma_px);
        return errors;
      };
      const DepthErrors blocks = measured(StereoMethod::kBlocks), semi_global = measured(StereoMethod::kSemiGlobal);
      EXPECT_LT(blocks.sigma_px, 1.3 * semi_global.sigma_px) << width_px;
      EXPECT_LT(blocks.share_wrong, 0.02) << width_px;
    }
}

TEST(StereoMatcher, NearTheGroundNothingIsMeasured) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kCarpet));
  StereoMatcher matcher(sheet);
  const auto frame = matcher.match(rig.taken(hovering(0.3, 0.3, 0.2)));
  ASSERT_TRUE(frame);
  const auto measured = std::count_if(frame->depth.depth_m.begin(), frame->depth.depth_m.end(), common::isMeasured);
  EXPECT_LT(measured, 376 * 240 / 10);
}

TEST(StereoMatcher, TheSamePairGivesTheSameBytes) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kWood));
  const common::RgbdFrame pair = rig.taken(hovering(1.2));
  StereoMatcher first(sheet), second(sheet);
  const auto a = first.match(pair), b = second.match(pair), again = first.match(pair);
  EXPECT_EQ(a->depth.depth_m, b->depth.depth_m);
  EXPECT_EQ(a->depth.depth_m, again->depth.depth_m);
  EXPECT_EQ(a->color.rgb, again->color.rgb);
}

class BadPair : public testing::Test {
 protected:
  std::string faultOf(const common::RgbdFrame& pair) {
    const auto frame = matcher_.match(pair);
    return frame ? "" : std::string(frame.error().name());
  }
  common::RgbdFrame good() { return rig_.taken(hovering(1.2, 0.2, 0.1)); }

  common::RgbdCameraConfig sheet_ = shippedPair();
  PairRig rig_{sheet_, furnishedRoom(Pattern::kCarpet)};
  StereoMatcher matcher_{sheet_};
};

TEST_F(BadPair, AGoodOneIsUsed) { EXPECT_EQ(faultOf(good()), ""); }

TEST_F(BadPair, OneCameraIsSilent) {
  common::RgbdFrame pair = good();
  pair.right = nullptr;
  EXPECT_EQ(faultOf(pair), "stereo.one-picture");
  pair = good();
  pair.color = {};
  EXPECT_EQ(faultOf(pair), "stereo.one-picture");
}

TEST_F(BadPair, PicturesOfAnotherSize) {
  common::RgbdFrame pair = good();
  auto right = std::make_shared<common::Image>(*pair.right);
  right->rgb.resize(right->rgb.size() / 2);
  pair.right = right;
  EXPECT_EQ(faultOf(pair), "stereo.size");
  pair = good();
  pair.camera.width_px = 752;
  EXPECT_EQ(faultOf(pair), "stereo.size");
}

TEST_F(BadPair, ACoveredLens) {
  common::RgbdFrame pair = good();
  auto right = std::make_shared<common::Image>(*pair.right);
  std::fill(right->rgb.begin(), right->rgb.end(), std::uint8_t{1});
  pair.right = right;
  EXPECT_EQ(faultOf(pair), "stereo.black");
  std::fill(right->rgb.begin(), right->rgb.end(), std::uint8_t{254});
  EXPECT_EQ(faultOf(pair), "stereo.white");
}

TEST_F(BadPair, LeftAndRightAreExchanged) {
  common::RgbdFrame pair = good();
  auto left = std::make_shared<const common::Image>(pair.color);
  pair.color = *pair.right;
  pair.right = left;
  EXPECT_EQ(faultOf(pair), "stereo.exchanged");
}

TEST_F(BadPair, TheCamerasHaveMovedAgainstEachOther) {
  common::RgbdCameraConfig moved = sheet_;
  moved.right_pitch_deg += 1.0;
  PairRig rig(moved, furnishedRoom(Pattern::kCarpet));
  EXPECT_EQ(faultOf(rig.taken(hovering(1.2, 0.2, 0.1))), "stereo.rows-apart");
}

TEST_F(BadPair, ATornPictureHasNoDepthBelowTheTear) {
  common::RgbdFrame pair = good();
  const common::RgbdFrame other = rig_.taken(hovering(1.2, -2.0, 1.5, 1.0));
  auto torn = std::make_shared<common::Image>(*pair.right);
  const std::size_t half = torn->rgb.size() / 2;
  std::copy(other.right->rgb.begin() + static_cast<std::ptrdiff_t>(half), other.right->rgb.end(),
            torn->rgb.begin() + static_cast<std::ptrdiff_t>(half));
  pair.right = torn;
  const auto frame = matcher_.match(pair);
  ASSERT_TRUE(frame);
  const auto middle = frame->depth.depth_m.begin() + 376 * 125;
  EXPECT_GT(std::count_if(frame->depth.depth_m.begin(), middle, common::isMeasured), 376 * 120 / 3);
  EXPECT_LT(std::count_if(middle, frame->depth.depth_m.end(), common::isMeasured), 376 * 115 / 10);
}

TEST(StereoMatcher, BareWallsHaveNoDepth) {
  const common::RgbdCameraConfig sheet = shippedPair();
  simulation::WorldModel bare = simulation::boxRoom();
  for (simulation::Shape& shape : bare.shapes) shape.pattern = Pattern::kBlank;
  PairRig rig(sheet, bare);
  StereoMatcher matcher(sheet);
  const auto frame = matcher.match(rig.taken(hovering(1.2)));
  ASSERT_TRUE(frame) << frame.error().text();
  EXPECT_LT(std::count_if(frame->depth.depth_m.begin(), frame->depth.depth_m.end(), common::isMeasured),
            376 * 240 / 50);
}

}  // namespace
}  // namespace swiftlet::vision
