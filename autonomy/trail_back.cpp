#include "autonomy/trail_back.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace swiftlet::autonomy {
namespace {

/// The hull of the smallest vehicle has been at both places, so no wall stands between them.
constexpr double kTrailPast_m = 0.25;

/// The oldest point of the trail in each square of side kTrailPast_m.
class OldestPoints {
 public:
  explicit OldestPoints(std::span<const Eigen::Vector2d> trail_m) : trail_m_(trail_m) {
    for (std::size_t i = 0; i < trail_m.size(); ++i) oldest_.try_emplace(squareOf(trail_m[i]), i);
  }
  /// The oldest point, of those that are oldest in their square, within kTrailPast_m of the point `at`.
  std::size_t near(std::size_t at) const {
    const auto [column, row] = squareOf(trail_m_[at]);
    std::size_t found = at;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const auto entry = oldest_.find({column + dx, row + dy});
            entry != oldest_.end() && (trail_m_[entry->second] - trail_m_[at]).norm() <= kTrailPast_m)
          found = std::min(found, entry->second);
    return found;
  }

 private:
  using Square = std::pair<int, int>;
  static Square squareOf(const Eigen::Vector2d& point_m) {
    return {static_cast<int>(std::floor(point_m.x() / kTrailPast_m)),
            static_cast<int>(std::floor(point_m.y() / kTrailPast_m))};
  }

  std::span<const Eigen::Vector2d> trail_m_;
  std::map<Square, std::size_t> oldest_;
};

}  // namespace

std::vector<Eigen::Vector2d> trailBackWithoutLoops(std::span<const Eigen::Vector2d> trail_m) {
  std::vector<Eigen::Vector2d> back_m;
  if (trail_m.empty()) return back_m;
  const OldestPoints oldest(trail_m);
  std::size_t at = trail_m.size() - 1;
  back_m.push_back(trail_m[at]);
  while (at > 0) {
    const std::size_t past = oldest.near(at);
    at = past < at ? past : at - 1;
    back_m.push_back(trail_m[at]);
  }
  return back_m;
}

}  // namespace swiftlet::autonomy
