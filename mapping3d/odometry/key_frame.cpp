#include "mapping3d/odometry/key_frame.hpp"

#include <algorithm>

namespace swiftlet::mapping3d {

std::vector<DescribedPoint> describedPoints(const vision::GrayImage& gray,
                                            const std::vector<vision::Feature>& features) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(features.size());
  for (const vision::Feature& feature : features) pixels.push_back(feature.pixel);
  const auto descriptors = vision::describePatches(gray, pixels);
  std::vector<DescribedPoint> points;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (descriptors[i]) points.push_back({features[i].mean_camera_m, *descriptors[i]});
  return points;
}

double medianDepth_m(const std::vector<ReferencePoint>& level) {
  if (level.empty()) return 0.0;
  std::vector<float> depths_m;
  depths_m.reserve(level.size());
  for (const ReferencePoint& point : level) depths_m.push_back(point.point_camera_m.x());
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::nth_element(depths_m.begin(), middle, depths_m.end());
  return static_cast<double>(*middle);
}

}  // namespace swiftlet::mapping3d
