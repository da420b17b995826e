#include "vision/stereo_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/blank_picture.hpp"
#include "common/check.hpp"
#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/whole_frame.hpp"
#include "vision/epipolar_check.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::vision {
namespace {

using common::Message;

/// Side of the blocks, odd: the same share of the width at all sizes, 9 pixels of 376 and 17 of 752.
int blockOf_px(int width_px) { return std::max(5, width_px / 94 * 2 + 1); }
/// OpenCV's disparities are whole sixteenths of a pixel.
constexpr double kSteps = 16.0;
/// Standard deviation of a disparity, as measured (docs/decisions/cameras_and_lasers.md#118).
constexpr double kDisparitySigma_px = 0.25;
/// Depth changes within a piece of surface by less than this between two pixels; smaller pieces are noise.
constexpr int kSpeckleRange_px = 2, kSpeckle_pixels = 60;

/// x to the right, y down, z along the view, as OpenCV has it.
cv::Mat opticalRotation(const Eigen::Quaterniond& rotation) {
  Eigen::Matrix3d optical_camera;
  optical_camera << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Matrix3d R = optical_camera * rotation.toRotationMatrix() * optical_camera.transpose();
  cv::Mat result(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result.at<double>(i, j) = R(i, j);
  return result;
}

/// Where each pixel of a rectified picture lies in the picture as it was taken.
struct Rectification {
  cv::Mat columns_and_rows, fractions;  ///< Both empty where nothing is to be done.

  cv::Mat of(const cv::Mat& picture) const {
    if (columns_and_rows.empty()) return picture;
    cv::Mat rectified;
    cv::remap(picture, rectified, columns_and_rows, fractions, cv::INTER_LINEAR);
    return rectified;
  }
};

/// `rotation` of the camera in the rectified frame.
Rectification rectificationOf(const common::RgbdCameraConfig& sheet, const Eigen::Quaterniond& rotation) {
  const bool is_straight = sheet.radial_k1 == 0.0 && sheet.radial_k2 == 0.0;
  Rectification result;
  if (is_straight && rotation.angularDistance(Eigen::Quaterniond::Identity()) == 0.0) return result;
  const common::PinholeCamera camera = sheet.camera();
  const cv::Matx33d K(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const cv::Vec4d distortion(sheet.radial_k1, sheet.radial_k2, 0.0, 0.0);
  cv::initUndistortRectifyMap(K, distortion, opticalRotation(rotation), K, {camera.width_px, camera.height_px},
                              CV_16SC2, result.columns_and_rows, result.fractions);
  return result;
}

/// OpenCV does not write to what it reads.
cv::Mat viewOf(const common::Image& image) {
  return {image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data())};
}
cv::Mat viewOf(const GrayImage& image) {
  return {image.height_px, image.width_px, CV_8UC1, const_cast<std::uint8_t*>(image.values.data())};
}

common::Image rectified(const common::Image& picture, const Rectification& rectification) {
  const cv::Mat result = rectification.of(viewOf(picture));
  return {picture.width_px, picture.height_px, std::vector<std::uint8_t>(result.datastart, result.dataend)};
}

cv::Ptr<cv::StereoMatcher> makeMatcher(StereoMethod method, int disparities, int width_px) {
  // A disparity is kept if that from right to left is the same up to a pixel.
  constexpr int kSameBothWays_px = 1;
  if (method == StereoMethod::kSemiGlobal) {
    constexpr int kBlock = 5;
    // The penalties of OpenCV's own example for one channel.
    auto matcher =
        cv::StereoSGBM::create(0, disparities, kBlock, 8 * kBlock * kBlock, 32 * kBlock * kBlock, kSameBothWays_px, 31,
                               10, kSpeckle_pixels, kSpeckleRange_px, cv::StereoSGBM::MODE_SGBM_3WAY);
    return matcher;
  }
  const int block_px = blockOf_px(width_px);
  auto matcher = cv::StereoBM::create(disparities, block_px);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setPreFilterCap(31);
  matcher->setTextureThreshold(block_px * block_px);
  matcher->setUniquenessRatio(12);
  matcher->setDisp12MaxDiff(kSameBothWays_px);
  matcher->setSpeckleWindowSize(kSpeckle_pixels);
  matcher->setSpeckleRange(kSpeckleRange_px);
  return matcher;
}

/// Why a picture cannot be used; none if it can.
std::optional<Message> faultOf(const common::Image& picture, const char* camera) {
  switch (common::blankOf(picture)) {
    case common::Blank::kBlack:
      return Message("stereo.black", "the picture of the {} camera is black", camera);
    case common::Blank::kWhite:
      return Message("stereo.white", "the picture of the {} camera is white", camera);
    case common::Blank::kNo:
      break;
  }
  return std::nullopt;
}

std::optional<Message> faultOf(const common::RgbdFrame& pair, const common::PinholeCamera& camera) {
  const bool has_right = pair.right && !pair.right->rgb.empty();
  if (!has_right || pair.color.rgb.empty())
    return Message("stereo.one-picture", "the picture of the {} camera is missing", has_right ? "left" : "right");
  if (!isWholePair(pair) || !(pair.camera == camera))
    return Message("stereo.size", "the pictures do not have the size of the camera");
  if (auto fault = faultOf(pair.color, "left")) return fault;
  return faultOf(*pair.right, "right");
}

}  // namespace

struct StereoMatcher::Impl {
  Impl(const common::RgbdCameraConfig& sheet, StereoMethod method)
      : camera(sheet.camera()),
        focal_base_px_m(camera.fx_px * sheet.baseline_m),
        noise{kDisparitySigma_px / focal_base_px_m, sheet.range_min_m, sheet.range_max_m},
        left(rectificationOf(sheet, Eigen::Quaterniond::Identity())),
        right(rectificationOf(sheet, sheet.T_left_right().rotation)),
        matcher(makeMatcher(method, disparitiesOf(sheet), sheet.width_px)) {
    // A library owns no threads.
    static const bool one_thread = (cv::setNumThreads(1), true);
    static_cast<void>(one_thread);
  }

  /// OpenCV searches a multiple of 16.
  int disparitiesOf(const common::RgbdCameraConfig& sheet) const {
    const int wanted = static_cast<int>(std::ceil(focal_base_px_m / sheet.range_min_m));
    return std::clamp((wanted + 15) / 16 * 16, 16, camera.width_px / 2 / 16 * 16);
  }
  common::DepthImage depthOf(const cv::Mat& disparity) const;

  common::PinholeCamera camera;
  double focal_base_px_m;
  DepthNoiseConfig noise;
  Rectification left, right;
  cv::Ptr<cv::StereoMatcher> matcher;
};

common::DepthImage StereoMatcher::Impl::depthOf(const cv::Mat& disparity) const {
  common::DepthImage depth{camera.width_px, camera.height_px, {}};
  depth.depth_m.reserve(static_cast<std::size_t>(camera.pixels()));
  const auto scaled = static_cast<float>(kSteps * focal_base_px_m);
  const auto nearest_m = static_cast<float>(noise.nearest_m), farthest_m = static_cast<float>(noise.farthest_m);
  for (int v = 0; v < camera.height_px; ++v) {
    const auto* row = disparity.ptr<std::int16_t>(v);
    for (int u = 0; u < camera.width_px; ++u) {
      const float depth_m = row[u] > 0 ? scaled / static_cast<float>(row[u]) : common::DepthImage::kUnknown;
      if (depth_m < nearest_m)
        depth.depth_m.push_back(common::DepthImage::kUnknown);
      else
        depth.depth_m.push_back(depth_m > farthest_m ? common::DepthImage::kTooFar : depth_m);
    }
  }
  return depth;
}

StereoMatcher::StereoMatcher(const common::RgbdCameraConfig& sheet, StereoMethod method) {
  SWIFTLET_CHECK(sheet.isStereo() && sheet.validate().empty(), sheet.name);
  impl_ = std::make_unique<Impl>(sheet, method);
}
StereoMatcher::~StereoMatcher() = default;
StereoMatcher::StereoMatcher(StereoMatcher&&) noexcept = default;
StereoMatcher& StereoMatcher::operator=(StereoMatcher&&) noexcept = default;

tl::expected<common::RgbdFrame, Message> StereoMatcher::match(const common::RgbdFrame& pair) {
  if (auto fault = faultOf(pair, impl_->camera)) return tl::unexpected(std::move(*fault));
  common::RgbdFrame frame;
  frame.stamps = pair.stamps;
  frame.row_time = pair.row_time;
  frame.camera = impl_->camera;
  frame.color = rectified(pair.color, impl_->left);
  const GrayImage left = grayOf(frame.color), right = grayOf(rectified(*pair.right, impl_->right));
  if (const auto residual = epipolarResidual(left, right))
    if (auto contradiction = contradictionOf(*residual)) return tl::unexpected(std::move(*contradiction));
  cv::Mat disparity;
  impl_->matcher->compute(viewOf(left), viewOf(right), disparity);
  frame.depth = impl_->depthOf(disparity);
  return frame;
}

const DepthNoiseConfig& StereoMatcher::noise() const { return impl_->noise; }

}  // namespace swiftlet::vision
