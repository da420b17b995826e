#include "rendering/resize.hpp"

#include <algorithm>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "common/check.hpp"

namespace swiftlet::rendering {

common::Image shrinkToWidth(const common::Image& image, int width_px) {
  SWIFTLET_CHECK(width_px > 0 && image.width_px > 0 && image.height_px > 0, width_px);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  if (image.width_px <= width_px) return image;
  const int height_px = std::max(1, static_cast<int>(static_cast<long>(image.height_px) * width_px / image.width_px));
  common::Image small{width_px, height_px, {}};
  small.rgb.resize(3 * static_cast<std::size_t>(width_px) * height_px);
  // By the calling thread alone: others belong to the flight.
  static const bool one_thread = (cv::setNumThreads(1), true);
  SWIFTLET_CHECK(one_thread);
  // OpenCV only reads what is const here, and writes in place where the size already fits.
  const cv::Mat from(image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat to(height_px, width_px, CV_8UC3, small.rgb.data());
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_AREA);
  return small;
}

}  // namespace swiftlet::rendering
