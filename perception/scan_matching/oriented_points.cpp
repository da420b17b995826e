#include "perception/scan_matching/oriented_points.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

/// Cell size of the look-up grid, at least: about three points of kSpacing_m lie in a cell along a wall. In large
/// scenes the cells grow, so that the grid stays within a few megabytes.
constexpr double kLeastCell_m = 0.1;
constexpr double kMostCells = 200'000;
constexpr double kSameSide_cos = 0.7071;  ///< 45 degrees: the other side and the walls at a corner do not pair.
/// Two neighbouring points whose normals agree at least this well belong to one surface.
constexpr float kSmooth_cos = 0.95F;

/// Whether the gap between two neighbours may be filled: the line between them runs along the surface of both.
bool isOneSurface(const OrientedPoint& a, const OrientedPoint& b, float max_gap_m) {
  const Eigen::Vector2f step = b.foot_m - a.foot_m;
  const float length = step.norm();
  return length < max_gap_m && a.normal.dot(b.normal) > kSmooth_cos && std::abs(step.dot(a.normal)) < 0.5F * length;
}

}  // namespace

void OrientedPoints::clear() {
  points_.clear();
  sorted_ = false;
}

void OrientedPoints::add(std::span<const OrientedPoint> scan, const common::Pose2& T_reference_body, double max_gap_m) {
  constexpr auto kSpacing = static_cast<float>(kSpacing_m);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_reference_body.yaw_rad).toRotationMatrix();
  const auto place = [&](const Eigen::Vector2f& point_m, const Eigen::Vector2f& normal) {
    points_.push_back({R * point_m.cast<double>() + T_reference_body.position_m(), R * normal.cast<double>()});
  };
  const OrientedPoint* last = nullptr;
  for (const OrientedPoint& p : scan) {
    const float gap_m = last == nullptr ? INFINITY : (p.foot_m - last->foot_m).norm();
    if (gap_m < kSpacing) continue;
    if (last != nullptr && isOneSurface(*last, p, static_cast<float>(max_gap_m))) {
      const int between = static_cast<int>(gap_m / kSpacing);
      for (int i = 1; i < between; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(between);
        place(last->foot_m + share * (p.foot_m - last->foot_m), share < 0.5F ? last->normal : p.normal);
      }
    }
    place(p.foot_m, p.normal);
    last = &p;
  }
  sorted_ = false;
}

void OrientedPoints::sort() {
  if (sorted_ || points_.empty()) return;
  Eigen::Vector2d low = points_.front().point_m, high = low;
  for (const Entry& p : points_) {
    low = low.cwiseMin(p.point_m);
    high = high.cwiseMax(p.point_m);
  }
  begin_m_ = low;
  const Eigen::Vector2d size_m = (high - low).cwiseMax(kLeastCell_m);
  cell_m_ = std::max({kLeastCell_m, std::sqrt(size_m.prod() / kMostCells), size_m.maxCoeff() / kMostCells});
  columns_ = static_cast<int>(size_m.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size_m.y() / cell_m_) + 1;

  // Stable counting sort.
  const auto cellOf = [&](const Entry& p) {
    const Eigen::Vector2d cell = (p.point_m - begin_m_) / cell_m_;
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(cell.x());
  };
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Entry& p : points_) ++first_[cellOf(p) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<int> next = first_;
  std::vector<Entry> sorted(points_.size());
  for (const Entry& p : points_) sorted[static_cast<std::size_t>(next[cellOf(p)]++)] = p;
  points_ = std::move(sorted);
  sorted_ = true;
}

int OrientedPoints::nearest(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal, double radius_m) const {
  const double x = (at_m.x() - begin_m_.x()) / cell_m_, y = (at_m.y() - begin_m_.y()) / cell_m_;
  const double radius = radius_m / cell_m_;
  // Also rejects NaN.
  if (!(x + radius >= 0.0 && y + radius >= 0.0 && x - radius < columns_ && y - radius < rows_)) return kNone;
  const int x0 = static_cast<int>(std::max(0.0, x - radius)), y0 = static_cast<int>(std::max(0.0, y - radius));
  const int x1 = static_cast<int>(std::min(x + radius, columns_ - 1.0));
  const int y1 = static_cast<int>(std::min(y + radius, rows_ - 1.0));
  double least2 = radius_m * radius_m;
  int best = kNone;
  for (int row = y0; row <= y1; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    const int end = first_[begin + static_cast<std::size_t>(x1) + 1];
    for (int i = first_[begin + static_cast<std::size_t>(x0)]; i < end; ++i) {
      const Entry& p = points_[static_cast<std::size_t>(i)];
      const double distance2 = (p.point_m - at_m).squaredNorm();
      if (distance2 >= least2 || p.normal.dot(normal) < kSameSide_cos) continue;
      least2 = distance2;
      best = i;
    }
  }
  return best;
}

}  // namespace swiftlet::perception
