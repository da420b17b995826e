#include "simulation/hull_geometry.hpp"

#include <algorithm>
#include <limits>

namespace swiftlet::simulation {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Eigen::Vector2d nearestOnSegment(const Segment2d& segment, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = segment.to_m - segment.from_m;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return segment.from_m;
  return segment.from_m + std::clamp((point - segment.from_m).dot(along) / squared, 0.0, 1.0) * along;
}

/// The point where two segments cross properly. Parallel segments are judged by their ends.
bool crossing(const Segment2d& a, const Segment2d& b, Eigen::Vector2d& point) {
  const Eigen::Vector2d u = a.to_m - a.from_m, v = b.to_m - b.from_m, w = b.from_m - a.from_m;
  const double denominator = cross(u, v);
  if (denominator == 0.0) return false;
  const double s = cross(w, v) / denominator, t = cross(w, u) / denominator;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return false;
  point = a.from_m + s * u;
  return true;
}

}  // namespace

Slice::Slice(const std::array<Eigen::Vector3d, 3>& triangle_m, double bottom_m, double top_m) {
  std::copy(triangle_m.begin(), triangle_m.end(), corners_.begin());
  clip(bottom_m, 1.0);
  clip(top_m, -1.0);
}

// Sutherland and Hodgman against one horizontal plane: keeps the part above it (side 1) or below it (side -1).
void Slice::clip(double height_m, double side) {
  std::array<Eigen::Vector3d, 8> kept;
  int count = 0;
  for (int i = 0; i < size_; ++i) {
    const Eigen::Vector3d& a = corners_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& b = corners_[static_cast<std::size_t>((i + 1) % size_)];
    const double over_a = side * (a.z() - height_m), over_b = side * (b.z() - height_m);
    if (over_a >= 0.0) kept[static_cast<std::size_t>(count++)] = a;
    if ((over_a < 0.0) != (over_b < 0.0))
      kept[static_cast<std::size_t>(count++)] = a + over_a / (over_a - over_b) * (b - a);
  }
  corners_ = kept;
  size_ = count;
}

bool Slice::contains(const Eigen::Vector2d& point_m) const {
  bool left = true, right = true;
  double area = 0.0;
  for (int i = 0; i < size_; ++i) {
    const Eigen::Vector2d a = corners_[static_cast<std::size_t>(i)].head<2>();
    const Eigen::Vector2d b = corners_[static_cast<std::size_t>((i + 1) % size_)].head<2>();
    const double turn = cross(b - a, point_m - a);
    left = left && turn >= 0.0;
    right = right && turn <= 0.0;
    area += cross(a, b);
  }
  return (left || right) && area != 0.0;
}

Nearest2d Slice::nearestTo(const Segment2d& segment) const {
  if (contains(segment.from_m)) return {0.0, segment.from_m};
  Nearest2d best{std::numeric_limits<double>::infinity(), {}};
  const auto consider = [&best](const Eigen::Vector2d& on_slice, const Eigen::Vector2d& on_segment) {
    const double distance = (on_slice - on_segment).norm();
    if (distance < best.distance_m) best = {distance, on_slice};
  };
  for (int i = 0; i < size_; ++i) {
    const Segment2d edge{corners_[static_cast<std::size_t>(i)].head<2>(),
                         corners_[static_cast<std::size_t>((i + 1) % size_)].head<2>()};
    Eigen::Vector2d point;
    if (crossing(segment, edge, point)) return {0.0, point};
    consider(edge.from_m, nearestOnSegment(segment, edge.from_m));
    consider(nearestOnSegment(edge, segment.from_m), segment.from_m);
    consider(nearestOnSegment(edge, segment.to_m), segment.to_m);
  }
  return best;
}

double Slice::height_m() const {
  double sum = 0.0;
  for (int i = 0; i < size_; ++i) sum += corners_[static_cast<std::size_t>(i)].z();
  return sum / size_;
}

}  // namespace swiftlet::simulation
