#include "perception/targets/blob_outline.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

namespace swiftlet::perception {
namespace {

/// The ring begins this far outside, as the pixels at the edge of a thing mix two depths, and is this wide.
constexpr int kGap_px = 2, kWidth_px = 2;

/// Three standard deviations of an inverse depth of a structured-light camera, noise and steps together: Khoshelham and
/// Elberink 2012.
constexpr double kThreeSigma_1_m = 3.0 * 0.0017;

/// Inverse depth = a + b * u + c * v, with u and v from the middle of the blob.
Eigen::Vector3d inverseDepthPlane(const ColoredBlob& blob, const common::RgbdFrame& frame,
                                  const Eigen::Vector2d& middle_px) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const int pixel : blob.pixels) {
    const Eigen::Vector3d row(1.0, pixel % frame.camera.width_px - middle_px.x(),
                              pixel / frame.camera.width_px - middle_px.y());
    squares += row * row.transpose();
    right += row / static_cast<double>(frame.depth.depth_m[static_cast<std::size_t>(pixel)]);
  }
  squares.diagonal() += Eigen::Vector3d(0.0, 1e-3, 1e-3);  // A blob of one row fixes no slope across it.
  return squares.inverse() * right;
}

/// The blob in a rectangle with a margin.
class Mask {
 public:
  Mask(const ColoredBlob& blob, int image_width)
      : left_(blob.left - kMargin),
        top_(blob.top - kMargin),
        width_(blob.right - blob.left + 1 + 2 * kMargin),
        height_(blob.bottom - blob.top + 1 + 2 * kMargin),
        steps_(static_cast<std::size_t>(width_ * height_), kFar) {
    for (const int pixel : blob.pixels) at(pixel % image_width - left_, pixel / image_width - top_) = 0;
  }
  /// Numbers the pixels around the blob by their distance from it, diagonal steps included.
  void spread() {
    for (int step = 1; step <= kMargin; ++step)
      for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
          if (at(x, y) == kFar && touches(x, y, step - 1)) at(x, y) = step;
  }
  template <typename Visit>
  void ring(Visit&& visit) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (at(x, y) > kGap_px && at(x, y) <= kMargin) visit(x + left_, y + top_);
  }

 private:
  static constexpr int kMargin = kGap_px + kWidth_px, kFar = 99;
  int& at(int x, int y) { return steps_[static_cast<std::size_t>(y * width_ + x)]; }
  bool touches(int x, int y, int step) {
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i)
        if (at(i, j) == step) return true;
    return false;
  }

  int left_, top_, width_, height_;
  std::vector<int> steps_;
};

}  // namespace

BlobOutline outlineOf(const ColoredBlob& blob, const common::RgbdFrame& frame, double relief_m) {
  const Eigen::Vector2d middle_px(0.5 * (blob.left + blob.right), 0.5 * (blob.top + blob.bottom));
  const Eigen::Vector3d plane = inverseDepthPlane(blob, frame, middle_px);
  BlobOutline outline;
  Mask mask(blob, frame.camera.width_px);
  mask.spread();
  mask.ring([&](int u, int v) {
    if (u < 0 || v < 0 || u >= frame.camera.width_px || v >= frame.camera.height_px) return;
    const float depth_m = frame.depth.at(u, v);
    const double expected_1_m = plane.dot(Eigen::Vector3d(1.0, u - middle_px.x(), v - middle_px.y()));
    if (depth_m == common::DepthImage::kTooFar) {
      ++outline.behind;
    } else if (!common::isMeasured(depth_m) || !(expected_1_m > 0.0)) {
      ++outline.unknown;
    } else {
      const double farther_1_m = expected_1_m - 1.0 / static_cast<double>(depth_m);
      const double least_1_m = std::max(kThreeSigma_1_m, relief_m * expected_1_m * expected_1_m);
      ++(farther_1_m > least_1_m ? outline.behind : farther_1_m < -least_1_m ? outline.in_front : outline.level);
    }
  });
  return outline;
}

}  // namespace swiftlet::perception
