// Whether the camera's focal length is the one that its frames show.
//
// With a wrong focal length frames still align, and the map is wrong in its scale across the view. It shows in what is
// left after the alignment: two views of one place fit better with another focal length. So each key frame is aligned
// to the one before with some other focal lengths too, and what their grey values do not explain is summed.
#pragma once

#include <array>
#include <optional>

#include "mapping3d/odometry/rgbd_odometry.hpp"

namespace swiftlet::mapping3d {

/// One thread. Costs seven alignments for each of the first key frames. It notices errors of about 20 % and more;
/// smaller ones often change the grey values too little.
class FocalCheck {
 public:
  /// `key` is seen from T_map_key, and `frame` was aligned to it and others with the result `pose`.
  void add(const FramePyramid& frame, const RgbdPose& pose, const KeyFrame& key, const common::Pose3& T_map_key,
           const RgbdOdometryConfig& config);

  /// Whether it has seen enough.
  bool isDone() const { return added_ >= kMostAdded; }
  /// Whether enough was seen for a result.
  bool canTell() const;
  /// The factor by which the focal length would fit clearly better; nullopt if it fits well, or if too little
  /// was seen.
  std::optional<double> betterFactor() const;

 private:
  /// A focal length does not change, so that later pairs would only cost more alignments.
  static constexpr int kMostAdded = 40;
  static constexpr std::array kFactors{1.0, 0.65, 0.8, 0.9, 1.1, 1.25, 1.55};

  int added_ = 0;
  std::array<double, kFactors.size()> unexplained_{};  ///< Sums of 1 - correlation.
};

}  // namespace swiftlet::mapping3d
