// A key frame: what later frames are aligned to, and what it is recognized by when the track was lost.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/time.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/reference_points.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {

using vision::DescribedPoint;

/// What was seen; where it was seen from is in the KeyFrameMap.
struct KeyFrame {
  common::Time stamp;
  std::vector<std::vector<ReferencePoint>> levels;  ///< Of its pyramid, the finest first.
  std::vector<DescribedPoint> described;
  double median_depth_m = 0.0;
};

/// `exposure` is that of the picture against the map; the key frame's grey values are those of the map.
std::shared_ptr<const KeyFrame> makeKeyFrame(common::Time stamp, const FramePyramid& pyramid,
                                             const std::vector<vision::Feature>& features, const Exposure& exposure,
                                             const vision::DepthNoiseConfig& noise);

/// Described are those features whose patch lies in the picture.
std::vector<DescribedPoint> describedPoints(const vision::GrayImage& gray,
                                            const std::vector<vision::Feature>& features);

/// Median depth of the points of a level. 0 without points.
double medianDepth_m(const std::vector<ReferencePoint>& level);

}  // namespace swiftlet::mapping3d
