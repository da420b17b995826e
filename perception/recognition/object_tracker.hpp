// Follows recognized objects from look to look, places them in the map, and decides what they are by all looks: a
// mirror that one look cannot tell from a window another look can, and a shutter may be closed meanwhile.
//
//   recognized --> to the frame of a key scan --> the track it belongs to (name, Mahalanobis) --> from another place?
//                                                     \--> none: a new candidate       --> Kalman update, evidence
//   opening --enough looks, surely open or closed, or a mirror--> confirmed;   pattern --enough looks--> confirmed
//
// A look from a place before shares its errors and adds nothing. Each object is kept relative to a key scan of the 2D
// map, so a loop closure moves it along.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/time.hpp"
#include "common/world/objects_layer.hpp"
#include "perception/recognition/recognized.hpp"
#include "perception/targets/point_estimate.hpp"

namespace swiftlet::perception {

/// Where and when a look was taken.
struct ObjectView {
  int key = 0;                    ///< Index of the key scan that the pose refers to.
  common::Pose3 T_key_camera;     ///< In the frame of that key scan.
  double position_sigma_m = 0.0;  ///< Of the camera's place in the map, beside the noise of a match.
  double turn_rate_rad_s = 0.0;   ///< Of the camera.
  common::Time stamp;
  const common::KeyPoses& keys;
};

/// Whether that is a name of an opening, which no pattern may have: `window`, `door`, `opening` or `mirror`.
bool isOpeningName(const std::string& what);

/// One thread. The same looks in the same order give the same bits.
class ObjectTracker {
 public:
  /// What one frame shows. What is not finite is left out, and so is a view whose pose is not.
  void add(const std::vector<Recognized>& recognized, const ObjectView& view);

  /// In the map, in the order of their ids, candidates and mirrors included.
  std::vector<common::RecognizedObject> objects(const common::KeyPoses& keys) const;

 private:
  /// Looks at an opening, by what they said.
  struct Evidence {
    int open = 0, closed = 0, mirror = 0;
    int doors = 0, windows = 0;
  };
  struct Track {
    int id = 0;
    std::string name;  ///< Of a pattern; empty for an opening.
    int key = 0;
    PointEstimate place_key;  ///< In the frame of that key scan, like the next three.
    Eigen::Quaterniond rotation_key_object = Eigen::Quaterniond::Identity();
    double heading_variance_rad2 = 0.0;
    std::vector<Eigen::Vector3d> from_key_m;
    Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
    Evidence evidence = {};
    int looks = 0;
    common::Time last_seen;
  };
  /// A recognized object in the frame of a key scan.
  struct Measured {
    PointMeasurement place;
    Eigen::Quaterniond rotation;
    double heading_variance_rad2 = 0.0;
  };
  static Measured measured(const Recognized& one, const ObjectView& view, int key);
  Track* trackOf(const Recognized& one, const ObjectView& view);
  void begin(const Recognized& one, const ObjectView& view);
  static void update(Track& track, const Recognized& one, const ObjectView& view);
  static void count(const Recognized& one, Track& track);
  void mergeDuplicates(const common::KeyPoses& keys);
  static void judge(const Evidence& evidence, common::RecognizedObject& object);

  std::vector<Track> tracks_;  ///< In the order of their ids.
  int last_id_ = 0;
};

}  // namespace swiftlet::perception
