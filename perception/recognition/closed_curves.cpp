#include "perception/recognition/closed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

/// Side of the window of the mean. A pattern is found in the level of the pyramid in which its shapes are this large.
constexpr int kWindow_px = 31;
/// The least area of which the moments still show a shape.
constexpr double kLeastCurveArea_px2 = 36.0;
/// Longer curves are not shapes of a pattern, but networks.
constexpr double kMostCurveShare = 0.5;
/// Ratio of the axes of the ellipse with the same moments; a disc seen from 80 degrees has 6.
constexpr double kGreatestSlant = 8.0;

/// Appends the curves of a mask of 0 and 255.
void appendCurves(const cv::Mat& mask, std::vector<ClosedCurve>& curves) {
  std::vector<std::vector<cv::Point>> contours;
  // Without approximation a contour goes through the centres of the outermost pixels.
  cv::findContours(mask, contours, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
  const double greatest_area = kMostCurveShare * mask.cols * mask.rows;
  for (const std::vector<cv::Point>& contour : contours) {
    const bool touches_border = std::any_of(contour.begin(), contour.end(), [&](const cv::Point& at) {
      return at.x <= 1 || at.y <= 1 || at.x >= mask.cols - 2 || at.y >= mask.rows - 2;
    });
    if (touches_border || contour.size() < 4) continue;
    const cv::Moments moments = cv::moments(contour);
    if (moments.m00 < kLeastCurveArea_px2 || moments.m00 > greatest_area) continue;
    const double xx = moments.mu20 / moments.m00, xy = moments.mu11 / moments.m00, yy = moments.mu02 / moments.m00;
    const double half_trace = 0.5 * (xx + yy);
    const double half_difference = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    const double larger = half_trace + half_difference, smaller = half_trace - half_difference;
    if (!(smaller > 0.0) || larger > kGreatestSlant * kGreatestSlant * smaller) continue;
    // The inverse of the symmetric square root: (S + sqrt(det) I)^-1 * sqrt(trace + 2 sqrt(det)).
    const double root = std::sqrt(larger * smaller);
    Eigen::Matrix2d adjugate;
    adjugate << yy + root, -xy, -xy, xx + root;
    ClosedCurve curve;
    curve.middle_px = {moments.m10 / moments.m00, moments.m01 / moments.m00};
    curve.whitening = adjugate * (std::sqrt(xx + yy + 2.0 * root) / ((xx + root) * (yy + root) - xy * xy));
    curve.area_px2 = moments.m00;
    curves.push_back(curve);
  }
}

}  // namespace

std::vector<ClosedCurve> findClosedCurves(const vision::GrayImage& gray, int contrast) {
  static const bool one_thread = (cv::setNumThreads(1), true);
  SWIFTLET_CHECK(one_thread);
  // OpenCV only reads what is const here.
  const cv::Mat picture(gray.height_px, gray.width_px, CV_8U, const_cast<std::uint8_t*>(gray.values.data()));
  // Integer filters: the same bytes on every machine.
  cv::Mat smooth, mean, mask;
  cv::blur(picture, smooth, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
  cv::blur(smooth, mean, {kWindow_px, kWindow_px}, {-1, -1}, cv::BORDER_REPLICATE);
  std::vector<ClosedCurve> curves;
  cv::Mat difference;
  cv::subtract(smooth, mean, difference);
  cv::threshold(difference, mask, contrast, 255, cv::THRESH_BINARY);
  appendCurves(mask, curves);
  cv::subtract(mean, smooth, difference);
  cv::threshold(difference, mask, contrast, 255, cv::THRESH_BINARY);
  appendCurves(mask, curves);
  return curves;
}

}  // namespace swiftlet::perception
