#include "common/world/trail.hpp"

#include <algorithm>

namespace swiftlet::common {

Trail::Trail(const std::vector<Eigen::Vector2d>& points_map_m) {
  TrailRecorder recorder;
  for (const Eigen::Vector2d& point_map_m : points_map_m) recorder.add(point_map_m);
  *this = recorder.trail();
}

bool Trail::continues(const Trail& earlier) const {
  if (size_ < earlier.size_) return false;
  if (points_map_m_ == earlier.points_map_m_) return true;
  const auto before = earlier.points_map_m();
  return std::equal(before.begin(), before.end(), points_map_m().begin());
}

void TrailRecorder::add(const Eigen::Vector2d& point_map_m) {
  constexpr std::size_t kFirstCapacity = 64;
  if (trail_.size_ == capacity_) {
    capacity_ = std::max(kFirstCapacity, 2 * capacity_);
    std::shared_ptr<Eigen::Vector2d[]> larger(new Eigen::Vector2d[capacity_]);
    std::copy_n(room_.get(), trail_.size_, larger.get());
    room_ = larger;
    trail_.points_map_m_ = std::move(larger);
  }
  room_[static_cast<std::ptrdiff_t>(trail_.size_)] = point_map_m;
  ++trail_.size_;
}

}  // namespace swiftlet::common
