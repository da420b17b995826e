#include "mapping3d/odometry/key_frame.hpp"

#include <algorithm>

namespace swiftlet::mapping3d {

std::shared_ptr<const KeyFrame> makeKeyFrame(common::Time stamp, const FramePyramid& pyramid,
                                             const std::vector<vision::Feature>& features, const Exposure& exposure,
                                             const vision::DepthNoiseConfig& noise) {
  auto key = std::make_shared<KeyFrame>();
  key->stamp = stamp;
  const auto gain = static_cast<float>(exposure.gain), offset = static_cast<float>(exposure.offset);
  for (const PyramidLevel& level : pyramid) {
    key->levels.push_back(referencePoints(level, noise));
    for (ReferencePoint& point : key->levels.back()) point.gray = (point.gray - offset) / gain;
  }
  key->described = describedPoints(pyramid.front().gray, features);
  key->median_depth_m = medianDepth_m(key->levels.back());
  return key;
}

std::vector<DescribedPoint> describedPoints(const vision::GrayImage& gray,
                                            const std::vector<vision::Feature>& features) {
  std::vector<DescribedPoint> points;
  for (const vision::DescribedPatch& patch : vision::describedPatches(gray, features))
    points.push_back({features[patch.index].mean_camera_m, patch.descriptor});
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
