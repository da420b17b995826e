// Where the vehicle has been: a path that grows at its end and is never copied as a whole.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

/// The points of a path, oldest first. Copies share the points. Safe to read from any thread, even while the recorder
/// appends points.
class Trail {
 public:
  Trail() = default;
  explicit Trail(const std::vector<Eigen::Vector2d>& points_map_m);

  std::span<const Eigen::Vector2d> points_map_m() const { return {points_map_m_.get(), size_}; }
  /// Whether it begins with all points of `earlier`. Constant time when both share their points.
  bool continues(const Trail& earlier) const;

 private:
  friend class TrailRecorder;
  std::shared_ptr<const Eigen::Vector2d[]> points_map_m_;
  std::size_t size_ = 0;
};

/// Makes a trail, point by point. One thread.
class TrailRecorder {
 public:
  TrailRecorder() = default;
  TrailRecorder(const TrailRecorder&) = delete;  // Two recorders would append to the same buffer.
  TrailRecorder& operator=(const TrailRecorder&) = delete;
  TrailRecorder(TrailRecorder&&) = default;
  TrailRecorder& operator=(TrailRecorder&&) = default;

  /// Amortized constant time. Trails that were returned before do not change.
  void add(const Eigen::Vector2d& point_map_m);
  const Trail& trail() const { return trail_; }

 private:
  std::shared_ptr<Eigen::Vector2d[]> room_;
  std::size_t capacity_ = 0;
  Trail trail_;
};

}  // namespace swiftlet::common
