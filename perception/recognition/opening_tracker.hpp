// Follows openings from look to look, and decides what they are by all of them: a mirror that one look cannot tell from
// a window another look can, and a shutter may be closed meanwhile.
//
//   recognized --> the track it belongs to (Mahalanobis) --> a look from another place? --> Kalman update, evidence
//                     \--> none: a new candidate
//   candidate --enough looks, surely open or closed--> confirmed
//
// A look from a place before shares its errors and adds nothing.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/recognition/recognized.hpp"

namespace swiftlet::perception {

/// An opening by all that was seen of it.
struct TrackedOpening {
  int id = 0;        ///< Unique in a tracker.
  std::string what;  ///< `door`, `window` or, as long as its lower end was not seen, `opening`.
  Eigen::Vector3d centre_map_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of the centre.
  Eigen::Vector3d normal_map = Eigen::Vector3d::Zero();     ///< Towards where it was seen from.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();         ///< Width and height, the greatest that was seen.
  Passage passage = Passage::kNone;                         ///< kNone until it is confirmed, and for a mirror.
  int looks = 0;
};

/// One thread. The same looks in the same order give the same bits.
class OpeningTracker {
 public:
  /// What one frame shows, and where it was taken; `position_sigma_m` is of that place in the map.
  void add(const std::vector<Recognized>& recognized, const common::Pose3& T_map_camera, double position_sigma_m);

  /// In the order of their ids, candidates and mirrors included.
  std::vector<TrackedOpening> openings() const;

 private:
  /// Looks by what they said.
  struct Evidence {
    int open = 0, closed = 0, mirror = 0;
    int doors = 0, windows = 0;
  };
  struct Track {
    TrackedOpening opening;
    Evidence evidence;
    std::vector<Eigen::Vector3d> from_map_m;
  };
  Track* trackOf(const Eigen::Vector3d& centre_map_m, const Eigen::Matrix3d& covariance_m2);
  static void count(const Recognized& one, Evidence& evidence);

  std::vector<Track> tracks_;
};

}  // namespace swiftlet::perception
