// The model of Saeedi's Algorithm 1: corners as persistent landmarks, each a Gaussian in the map.
//
// Source: Saeedi et al., section III-C.3, after I. Dryanovski, R. G. Valenti, J. Xiao, "Fast visual odometry and
// mapping from RGB-D data", ICRA 2013: a feature that a landmark explains updates it by a Kalman filter, others become
// landmarks, and the model is bounded.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "vision/features.hpp"

namespace swiftlet::mapping3d {

struct Landmark {
  std::uint64_t number = 0;  ///< It keeps it for life.
  Eigen::Vector3d mean_map_m;
  Eigen::Matrix3d covariance_map_m2;
  int scan = 0;                  ///< The key scan on which it hangs, see KeyFramePlace.
  std::uint64_t first_seen = 0;  ///< Number of a frame.
  std::uint64_t last_seen = 0;   ///< Number of a frame.
};

class LandmarkModel {
 public:
  explicit LandmarkModel(std::size_t greatest_number = 3000) : greatest_number_(greatest_number) {}

  /// Their numbers ascend.
  const std::vector<Landmark>& all() const { return landmarks_; }
  /// nullptr if it was dropped.
  const Landmark* find(std::uint64_t number) const;
  /// Those in a picture from that pose, or beside it by at most `margin_px`.
  std::vector<Landmark> inView(const common::PinholeCamera& camera, const common::Pose3& T_map_camera,
                               double margin_px) const;

  /// The number of the new landmark.
  std::uint64_t add(const vision::Feature& feature, const common::Pose3& T_map_camera, int scan, std::uint64_t frame);
  /// Kalman update of a landmark by a feature of a frame; nothing if it was dropped.
  void update(std::uint64_t number, const vision::Feature& feature, const common::Pose3& T_map_camera,
              std::uint64_t frame);
  /// Nothing if it was dropped.
  void moveTo(std::uint64_t number, const Eigen::Vector3d& mean_map_m);
  /// Drops what is beyond the greatest number: what was seen longest ago.
  void shrink();

  /// Hangs those that were first seen in that frame on another key scan; they stay where they are.
  void hangOn(int scan, std::uint64_t first_seen);
  /// Moves the landmarks with the key scans that they hang on.
  void moveTo(const common::KeyPoses& from, const common::KeyPoses& to);
  void clear() { landmarks_.clear(); }

 private:
  Landmark* changeable(std::uint64_t number);

  std::size_t greatest_number_;
  std::vector<Landmark> landmarks_;
  std::uint64_t next_number_ = 0;
};

}  // namespace swiftlet::mapping3d
