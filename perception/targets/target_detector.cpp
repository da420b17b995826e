#include "perception/targets/target_detector.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "common/whole_frame.hpp"
#include "perception/targets/blob_outline.hpp"
#include "perception/targets/colored_blobs.hpp"

namespace swiftlet::perception {
namespace {

/// Least pixels of a target; smaller ones are too far away.
constexpr int kPixelsMin = 40;
/// Least diameter of a target of unknown diameter.
constexpr double kDiameterMin_m = 0.08;
/// Greatest diameter of a target of unknown diameter.
constexpr double kDiameterMax_m = 0.5;
/// Greatest difference from a known diameter, as a share of it.
constexpr double kDiameterTolerance = 0.5;
/// Least share of the rectangle around a target that it fills: a disc fills 0.79, a strip on the slant little.
constexpr double kFillMin = 0.5;
/// What is next to a target in the picture counts as behind it if it is farther by this than the target's surface
/// continued. On a picture of a target, no neighbour is.
constexpr double kRelief_m = 0.04;
/// Least share of a target's outline with something behind it.
constexpr double kOutlineShareMin = 0.5;
/// Greatest share of a target's outline with something in front of it, as the floor before a target is.
constexpr double kHiddenShareMax = 0.4;

/// A ring of which a smaller share has a depth is not judged.
constexpr double kKnownShare = 0.25;
/// The mean depth of the visible half of a ball is two thirds of its radius in front of its middle; the face of a box
/// is a whole half side in front, and a flat plate none. So the middle is a third of the diameter behind what is seen,
/// give or take a sixth.
constexpr double kBehind = 1.0 / 3.0, kBehindSigma = 1.0 / 6.0;
/// The middle of the visible part is that of the target within this share of its diameter: light and shade take pixels
/// from one side.
constexpr double kAsideSigma = 0.08;

/// A blob in metres.
struct Extent {
  Eigen::Vector3d mean_camera_m = Eigen::Vector3d::Zero();
  double area_m2 = 0.0;
  double fill = 0.0;  ///< Share of the rectangle around it.
};

Extent extentOf(const ColoredBlob& blob, const common::RgbdFrame& frame) {
  Extent extent;
  const int width = frame.camera.width_px;
  for (const int pixel : blob.pixels) {
    const double depth_m = static_cast<double>(frame.depth.depth_m[static_cast<std::size_t>(pixel)]);
    extent.mean_camera_m += frame.camera.point_camera_m(pixel % width, pixel / width, depth_m);
    extent.area_m2 += depth_m * depth_m / (frame.camera.fx_px * frame.camera.fy_px);
  }
  const auto count = static_cast<double>(blob.pixels.size());
  extent.mean_camera_m /= count;
  extent.fill = count / ((blob.right - blob.left + 1) * (blob.bottom - blob.top + 1));
  return extent;
}

bool touchesTheEdge(const ColoredBlob& blob, const common::PinholeCamera& camera) {
  return blob.left == 0 || blob.top == 0 || blob.right == camera.width_px - 1 || blob.bottom == camera.height_px - 1;
}

}  // namespace

TargetDetector::TargetDetector(std::vector<TargetClassConfig> classes)
    : classes_(std::move(classes)), colors_(classes_) {}

std::vector<TargetSighting> TargetDetector::detect(const common::RgbdFrame& frame) const {
  std::vector<TargetSighting> sightings;
  if (!isWhole(frame)) return sightings;
  for (const ColoredBlob& blob : coloredBlobs(frame, colors_, kPixelsMin)) {
    if (touchesTheEdge(blob, frame.camera)) continue;
    const Extent extent = extentOf(blob, frame);
    const double diameter_m = std::sqrt(4.0 * extent.area_m2 / std::numbers::pi);
    if (extent.fill < kFillMin || !hasSize(blob.color, diameter_m)) continue;
    const BlobOutline outline = outlineOf(blob, frame, kRelief_m);
    const double known = outline.known();
    if (known < kKnownShare * (known + outline.unknown)) continue;
    if (outline.behind < kOutlineShareMin * known || outline.in_front > kHiddenShareMax * known) continue;
    const double size_m = classes_[blob.color].diameter_m > 0.0 ? classes_[blob.color].diameter_m : diameter_m;
    const Eigen::Vector3d along = extent.mean_camera_m.normalized();
    TargetSighting sighting{blob.color, extent.mean_camera_m + kBehind * size_m * along, {}, diameter_m};
    const double aside_m = kAsideSigma * size_m, behind_m = kBehindSigma * size_m;
    const Eigen::Matrix3d line = along * along.transpose();
    sighting.covariance_m2 = behind_m * behind_m * line + aside_m * aside_m * (Eigen::Matrix3d::Identity() - line);
    sightings.push_back(sighting);
  }
  return sightings;
}

bool TargetDetector::hasSize(std::uint8_t color, double diameter_m) const {
  const double expected_m = classes_[color].diameter_m;
  if (!(expected_m > 0.0)) return diameter_m >= kDiameterMin_m && diameter_m <= kDiameterMax_m;
  return std::abs(diameter_m - expected_m) <= kDiameterTolerance * expected_m;
}

}  // namespace swiftlet::perception
