// The key frames of a map and the choice of those that a frame is aligned to. Their number is bounded.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/config_fwd.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "mapping3d/odometry/key_frame.hpp"

namespace swiftlet::mapping3d {

struct KeyFrameConfig {
  int greatest_number = 400;
  int views = 3;
  double least_overlap = 0.6;
  double greatest_turn_rad = 0.35;
  double greatest_step = 0.2;

  void describe(common::config::Fields& fields);
};

class KeyFrameMap {
 public:
  explicit KeyFrameMap(const KeyFrameConfig& config) : config_(config) {}

  /// Beyond the greatest number, the one that was used longest ago is dropped.
  void add(std::shared_ptr<const KeyFrame> key);
  bool isEmpty() const { return keys_.empty(); }
  std::size_t size() const { return keys_.size(); }
  const KeyFrame& at(std::size_t index) const { return *keys_[index].frame; }

  /// Up to `views` key frames that overlap most with what the camera would see, the best first.
  std::vector<std::size_t> overlapping(const common::PinholeCamera& coarsest, const common::Pose3& T_map_camera) const;
  /// As views of an alignment. They are valid until the next add().
  std::vector<ReferenceView> views(const std::vector<std::size_t>& indices) const;
  /// Keeps them from being dropped for a while.
  void markUsed(const std::vector<std::size_t>& indices);

  /// Whether what the camera sees from there is covered too little by its nearest key frame.
  bool needsNew(const std::vector<std::size_t>& overlapping, const common::Pose3& T_map_camera, double overlap) const;

 private:
  struct Kept {
    std::shared_ptr<const KeyFrame> frame;
    std::uint64_t used = 0;
  };
  KeyFrameConfig config_;
  std::vector<Kept> keys_;
  std::uint64_t clock_ = 0;
};

}  // namespace swiftlet::mapping3d
