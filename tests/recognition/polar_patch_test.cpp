#include "perception/recognition/polar_patch.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "perception/recognition/picture_pyramid.hpp"
#include "tests/recognition/pattern_scene.hpp"

namespace swiftlet::perception {
namespace {

using vision::GrayImage;

/// The mark on a white sheet, mapped by an affine transform about the middle.
GrayImage mapped(const Eigen::Matrix2d& map) {
  const GrayImage mark = landingMark(120);
  GrayImage picture{240, 240, {}};
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 240; ++u) {
      const Eigen::Vector2d from = map.inverse() * Eigen::Vector2d(u - 119.5, v - 119.5) + Eigen::Vector2d(59.5, 59.5);
      picture.values.push_back(isInside(mark, from.x(), from.y(), 0.0)
                                   ? static_cast<std::uint8_t>(
                                         interpolated(mark, static_cast<float>(from.x()), static_cast<float>(from.y())))
                                   : 255);
    }
  return picture;
}

Eigen::Matrix2d turned(double angle_rad) { return Eigen::Rotation2Dd(angle_rad).toRotationMatrix(); }

/// The curve around the disc of the mark, found at a quarter of the size: the window of the mean is larger then.
ClosedCurve discOf(const GrayImage& picture) {
  ClosedCurve largest;
  for (const ClosedCurve& curve : findClosedCurves(vision::halved(vision::halved(picture)), 10))
    if (curve.area_px2 > largest.area_px2 && (curve.middle_px - Eigen::Vector2d(29.5, 29.5)).norm() < 3.0)
      largest = curve;
  largest.middle_px = 4.0 * largest.middle_px + Eigen::Vector2d(1.5, 1.5);
  largest.whitening /= 4.0;
  return largest;
}

TEST(ClosedCurves, TheMomentsOfASlantedDiscMakeItRoundAgain) {
  const Eigen::Matrix2d map = turned(0.4) * Eigen::Vector2d(1.3, 0.7).asDiagonal() * turned(-0.9);
  const ClosedCurve curve = discOf(mapped(map));
  ASSERT_GT(curve.area_px2, 0.0);
  // The radius of the disc is 54 px, and that of the whitened one 2. A contour runs through the centres of the
  // outermost pixels, half a pixel inside, which is two here.
  const Eigen::Matrix2d round = curve.whitening * map * 27.0;
  EXPECT_LT((round.transpose() * round - Eigen::Matrix2d::Identity()).norm(), 0.35);
}

TEST(PolarPatch, ATurnIsFoundAgain) {
  const GrayImage straight = mapped(Eigen::Matrix2d::Identity());
  const auto known = polarPatch(straight, discOf(straight), kPatchRings);
  ASSERT_TRUE(known);
  for (int degrees = -170; degrees <= 180; degrees += 35) {
    const double turn_rad = degrees * std::numbers::pi / 180.0;
    const GrayImage picture = mapped(turned(turn_rad));
    const auto seen = polarPatch(picture, discOf(picture), kPatchRings);
    ASSERT_TRUE(seen);
    const PatchMatch match = bestTurn(*known, *seen, 0.5F);
    EXPECT_GT(match.correlation, 0.85F) << degrees;
    EXPECT_LT(std::abs(std::remainder(match.turn_rad - turn_rad, 2.0 * std::numbers::pi)), 0.1) << degrees;
  }
}

/// What is left out by the bound correlates less than asked at every turn.
TEST(PolarPatch, TheBoundLeavesOutNoneThatCorrelates) {
  const auto known = polarPatch(mapped(Eigen::Matrix2d::Identity()), discOf(mapped(Eigen::Matrix2d::Identity())), 6);
  const CameraPicture picture = render(drawScene(5, 1, 0.5), {landingMark(100), landingDecoys(100)}, {});
  ASSERT_TRUE(known);
  int left_out = 0;
  for (const ClosedCurve& curve : findClosedCurves(picture.gray, 5)) {
    const auto seen = polarPatch(picture.gray, curve, kPatchRings);
    if (!seen) continue;
    const PatchMatch bounded = bestTurn(*known, *seen, 0.6F), all = bestTurn(*known, *seen, -1.0F);
    left_out += bounded.correlation == -1.0F ? 1 : 0;
    if (all.correlation >= 0.6F) {
      EXPECT_EQ(bounded.correlation, all.correlation);
    }
  }
  EXPECT_GT(left_out, 0);
}

}  // namespace
}  // namespace swiftlet::perception
