// The key frames of a map and the choice of those that a frame is aligned to. Their number is bounded.
//
// Each key frame hangs on a key scan of the 2D map. When a loop closure moves the key scans, the key frames move with
// them. Without key scans every key frame hangs on the origin of the map.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/key_frame.hpp"
#include "mapping3d/odometry/place_index.hpp"

namespace swiftlet::mapping3d {

/// Where a key frame was seen from.
struct KeyFramePlace {
  common::Pose3 T_map_key;
  int scan = 0;  ///< The key scan on which it hangs: index into common::KeyPoses::keys.
  /// Key frames of different tracks were not aligned to each other, so a frame is aligned only to those of one.
  int track = 0;
  /// Of the error (x, y, z, rotation vector) against the map, with the axes of the map.
  Matrix6d covariance = Matrix6d::Zero();
};

class KeyFrameMap {
 public:
  /// Key frames that a frame is aligned to, at most (docs/decisions/mapping3d.md#032).
  static constexpr std::size_t kAlignedTo = 3;

  explicit KeyFrameMap(int greatest_number = 400) : greatest_number_(greatest_number) {}

  /// Beyond the greatest number, the one that was used longest ago is dropped.
  void add(std::shared_ptr<const KeyFrame> key, const KeyFramePlace& place);
  bool isEmpty() const { return keys_.empty(); }
  std::size_t size() const { return keys_.size(); }
  const KeyFrame& at(std::size_t index) const { return *keys_[index].frame; }
  const KeyFramePlace& placeOf(std::size_t index) const { return keys_[index].place; }

  /// Hangs a key frame on another key scan; it stays where it is.
  void hang(std::size_t index, int scan);
  /// The key frames of the track `from` become those of `into`.
  void joinTracks(int from, int into);
  /// Moves the key frames with the key scans that they hang on.
  void moveTo(std::shared_ptr<const common::KeyPoses> scans);
  /// The identity without key scans.
  common::Pose3 T_map_scan(int scan) const;

  /// Up to `greatest` key frames of one track that overlap most with what the camera would see, the best first. The
  /// track is that of the best one, unless it is given.
  std::vector<std::size_t> overlapping(const common::PinholeCamera& coarsest, const common::Pose3& T_map_camera,
                                       std::optional<int> track = std::nullopt,
                                       std::size_t greatest = kAlignedTo) const;
  /// As views of an alignment. They are valid until the next add().
  std::vector<ReferenceView> views(const std::vector<std::size_t>& indices) const;
  /// Keeps them from being dropped for a while.
  void markUsed(const std::vector<std::size_t>& indices);

  /// Up to `greatest` key frames that look most like a picture with these points, the best first.
  std::vector<std::size_t> similar(const std::vector<DescribedPoint>& points, std::size_t greatest) const;

  /// Whether what the camera sees from there is covered too little by its nearest key frame.
  bool needsNew(const std::vector<std::size_t>& overlapping, const common::Pose3& T_map_camera, double overlap) const;

 private:
  struct Kept {
    std::shared_ptr<const KeyFrame> frame;
    KeyFramePlace place;
    common::Pose3 T_scan_key;
    std::uint64_t used = 0;
    std::uint64_t number = 0;  ///< Ascending in keys_.
  };
  int greatest_number_;
  std::shared_ptr<const common::KeyPoses> scans_;  ///< Null without a 2D map.
  std::vector<Kept> keys_;
  PlaceIndex places_;
  std::uint64_t clock_ = 0;
  std::uint64_t next_number_ = 0;
};

}  // namespace swiftlet::mapping3d
