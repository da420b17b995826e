#include "vision/binary_descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "common/random.hpp"

namespace swiftlet::vision {
namespace {

/// The patch of ORB at one scale: comparisons within 13 pixels, the direction from a disc of 15.
constexpr int kPatch_px = 13;
constexpr int kDisc_px = 15;
constexpr int kComparisons = 256;
/// Directions are rounded to 12 degrees, as ORB does, so that the turned patterns are made once.
constexpr int kDirections = 30;
/// Half the side of the box that smooths the picture: BRIEF compares means of 5x5 pixels.
constexpr int kBox_px = 2;
constexpr int kPatchBorder_px = std::max(kPatch_px + kBox_px, kDisc_px) + 1;

struct Offset {
  int u_px = 0, v_px = 0;
};
struct Comparison {
  Offset a, b;
};
using Pattern = std::array<Comparison, kComparisons>;

Offset turned(double u_px, double v_px, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {static_cast<int>(std::lround(c * u_px - s * v_px)), static_cast<int>(std::lround(s * u_px + c * v_px))};
}

/// Offsets are drawn from the isotropic Gaussian that BRIEF found best, with a standard deviation of 1/5 of the patch.
std::array<Pattern, kDirections> makePatterns() {
  common::RandomStream random(1, "binary descriptor");
  const auto offset = [&random] {
    Eigen::Vector2d drawn;
    do drawn = {random.gaussian(0.4 * kPatch_px), random.gaussian(0.4 * kPatch_px)};
    while (drawn.norm() > kPatch_px - 0.5);
    return drawn;
  };
  std::array<Pattern, kDirections> patterns;
  for (std::size_t i = 0; i < kComparisons; ++i) {
    const Eigen::Vector2d a = offset(), b = offset();
    for (std::size_t d = 0; d < kDirections; ++d) {
      const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(d) / kDirections;
      patterns[d][i] = {turned(a.x(), a.y(), angle_rad), turned(b.x(), b.y(), angle_rad)};
    }
  }
  return patterns;
}

/// Sums of all pixels above and to the left.
class IntegralImage {
 public:
  explicit IntegralImage(const GrayImage& image)
      : stride_(image.width_px + 1), sums_(static_cast<std::size_t>(stride_ * (image.height_px + 1)), 0) {
    for (int v = 0; v < image.height_px; ++v) {
      int row = 0;
      for (int u = 0; u < image.width_px; ++u) {
        row += image.at(u, v);
        sums_[index(u + 1, v + 1)] = sums_[index(u + 1, v)] + row;
      }
    }
  }
  /// The sum over the box around a pixel.
  int box(int u, int v) const {
    const int left = u - kBox_px, right = u + kBox_px + 1, top = v - kBox_px, bottom = v + kBox_px + 1;
    return sums_[index(right, bottom)] - sums_[index(left, bottom)] - sums_[index(right, top)] +
           sums_[index(left, top)];
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(u);
  }
  int stride_;
  std::vector<int> sums_;
};

/// The direction from the pixel to the centroid of the grey values of the disc, as a number of the turned pattern.
std::size_t directionOf(const GrayImage& image, int u, int v) {
  int moment_u = 0, moment_v = 0;
  for (int dv = -kDisc_px; dv <= kDisc_px; ++dv) {
    const std::uint8_t* row = image.row(v + dv);
    for (int du = -kDisc_px; du <= kDisc_px; ++du) {
      if (du * du + dv * dv > kDisc_px * kDisc_px) continue;
      moment_u += du * row[u + du];
      moment_v += dv * row[u + du];
    }
  }
  const double turns = std::atan2(moment_v, moment_u) / (2.0 * std::numbers::pi);
  return static_cast<std::size_t>(std::lround(turns * kDirections) + kDirections) % kDirections;
}

}  // namespace

std::vector<std::optional<BinaryDescriptor>> describePatches(const GrayImage& image,
                                                             std::span<const Eigen::Vector2d> pixels) {
  static const std::array<Pattern, kDirections> kPatterns = makePatterns();
  const IntegralImage integral(image);
  std::vector<std::optional<BinaryDescriptor>> descriptors(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto u = static_cast<int>(std::lround(pixels[i].x())), v = static_cast<int>(std::lround(pixels[i].y()));
    if (u < kPatchBorder_px || v < kPatchBorder_px || u + kPatchBorder_px >= image.width_px ||
        v + kPatchBorder_px >= image.height_px)
      continue;
    const Pattern& pattern = kPatterns[directionOf(image, u, v)];
    BinaryDescriptor& descriptor = descriptors[i].emplace();
    for (std::size_t bit = 0; bit < kComparisons; ++bit) {
      const auto& [a, b] = pattern[bit];
      if (integral.box(u + a.u_px, v + a.v_px) < integral.box(u + b.u_px, v + b.v_px))
        descriptor.bits[bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
  }
  return descriptors;
}

}  // namespace swiftlet::vision
