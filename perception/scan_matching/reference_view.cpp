#include "perception/scan_matching/reference_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "perception/scan_matching/split_points.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Bins between two neighbouring beams count as seen if the beams are at most this far apart.
constexpr int kJoinedBins = 5;
/// The view ends at a gap of this many degrees without an end point.
constexpr int kEndBins = 20;
/// Points up to this far behind the end points count as seen, because walls are rough and poses err.
constexpr double kBehind_m = 0.15;
/// A normal is that of the line between the nearest points on either side that are this far away, over steps along one
/// surface. Shorter lines are noise; a point that lies farther off its line than this share of its length is a corner.
constexpr double kNormalReach_m = 0.10, kLongestStep_m = 0.6, kLeastLine_m = 0.08, kBend = 0.25;
/// A surface is the back of one that a reference scan saw if it faces the other way, by more than 120 deg, and lies
/// beside it: this far off its plane, as a wall is thick, and from its nearest end point. Over a grazing stretch
/// of wall range noise turns a normal by tens of degrees, so one that merely faces away from the scan is no evidence.
constexpr double kOpposite = -0.5, kThickest_m = 0.5, kNearby_m = 1.0;

/// The unit normal of the surface at a point, towards the laser at the origin; zero if it is not known.
Eigen::Vector2d normalAt(std::span<const float> x_m, std::span<const float> y_m, std::size_t i) {
  const auto at = [&](std::size_t k) { return Eigen::Vector2d(x_m[k], y_m[k]); };
  const Eigen::Vector2d here = at(i);
  std::size_t first = i, last = i;
  while (first > 0 && (at(first) - here).norm() < kNormalReach_m && (at(first - 1) - at(first)).norm() < kLongestStep_m)
    --first;
  while (last + 1 < x_m.size() && (at(last) - here).norm() < kNormalReach_m &&
         (at(last + 1) - at(last)).norm() < kLongestStep_m)
    ++last;
  const Eigen::Vector2d line = at(last) - at(first);
  const double length_m = line.norm();
  if (!(length_m > kLeastLine_m)) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d normal = Eigen::Vector2d(-line.y(), line.x()) / length_m;
  if (std::abs(normal.dot(here - at(first))) > kBend * length_m) return Eigen::Vector2d::Zero();
  return normal.dot(here) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

int ReferenceView::binOf(double angle_rad) {
  const auto bin = static_cast<int>(std::floor((angle_rad + std::numbers::pi) * (kBins / (2.0 * std::numbers::pi))));
  return std::clamp(bin, 0, kBins - 1);
}

void ReferenceView::add(const std::vector<Eigen::Vector2f>& points_body_m, const Pose2& T_reference_body) {
  Scan scan;
  scan.T_body_reference = T_reference_body.inverse();
  const SplitPoints split(points_body_m);
  std::array<float, kBins> ends_m{};
  const auto wrapped = [](int bin) { return static_cast<std::size_t>((bin + kBins) % kBins); };
  int last_bin = 0;
  float last_m = 0.0F;
  for (std::size_t i = 0; i < points_body_m.size(); ++i) {
    const Eigen::Vector2f& point = points_body_m[i];
    const float range_m = std::min(point.norm(), max_range_m_);
    if (!std::isfinite(range_m)) continue;
    const Surface surface{point, normalAt(split.x_m, split.y_m, i).cast<float>()};
    const int bin = binOf(std::atan2(point.y(), point.x()));
    int step = bin - last_bin;
    if (step > kBins / 2) step -= kBins;
    if (step < -kBins / 2) step += kBins;
    const auto reach = [&](int at, float to_m) {
      float& end_m = ends_m[wrapped(at)];
      if (to_m > end_m) scan.surfaces[wrapped(at)] = surface;
      end_m = std::max(end_m, to_m);
    };
    if (last_m > 0.0F && std::abs(step) <= kJoinedBins)
      for (int k = 1; k < std::abs(step); ++k) reach(last_bin + (step < 0 ? -k : k), std::max(range_m, last_m));
    reach(bin, range_m);
    last_bin = bin;
    last_m = range_m;
  }
  for (int bin = 0; bin < kBins; ++bin)
    scan.seen_to_m[static_cast<std::size_t>(bin)] =
        std::max({ends_m[wrapped(bin - 1)], ends_m[wrapped(bin)], ends_m[wrapped(bin + 1)]});

  // Distance, in bins, to the nearest gap of at least kEndBins, in both directions. Two rounds, because a gap may wrap
  // around.
  std::array<int, kBins> to_end;
  to_end.fill(kBins);
  for (const int direction : {1, -1}) {
    int empty = 0, since_end = kBins;
    for (int k = 0; k < 2 * kBins; ++k) {
      const std::size_t bin = wrapped(direction * k % kBins);
      empty = ends_m[bin] > 0.0F ? 0 : empty + 1;
      since_end = empty >= kEndBins ? 0 : since_end + 1;
      to_end[bin] = std::min(to_end[bin], since_end);
    }
  }
  for (std::size_t bin = 0; bin < kBins; ++bin)
    scan.sine_to_end[bin] =
        to_end[bin] >= kBins / 4 ? 1.0F : static_cast<float>(std::sin(to_end[bin] * 2.0 * std::numbers::pi / kBins));
  scans_.push_back(scan);
}

bool ReferenceView::looksAt(const Scan& scan, const Eigen::Vector2d& point_m, double margin_m) {
  const double range_m = point_m.norm();
  if (!std::isfinite(range_m)) return false;
  const auto bin = static_cast<std::size_t>(binOf(std::atan2(point_m.y(), point_m.x())));
  return range_m <= static_cast<double>(scan.seen_to_m[bin]) + kBehind_m &&
         range_m * static_cast<double>(scan.sine_to_end[bin]) >= margin_m;
}

bool ReferenceView::isBack(const Scan& scan, const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal) {
  const Surface& seen = scan.surfaces[static_cast<std::size_t>(binOf(std::atan2(point_m.y(), point_m.x())))];
  const Eigen::Vector2d seen_normal = seen.normal.cast<double>(), offset_m = point_m - seen.point_m.cast<double>();
  return normal.dot(seen_normal) < kOpposite && std::abs(seen_normal.dot(offset_m)) < kThickest_m &&
         offset_m.norm() < kNearby_m;
}

std::vector<ReferenceView::Sight> ReferenceView::look(std::span<const float> x_m, std::span<const float> y_m,
                                                      const Pose2& T_reference_body, double margin_m) const {
  struct Placed {
    Eigen::Matrix2d rotation;
    Eigen::Vector2d position_m;
  };
  std::vector<Placed> T_scan_body;
  T_scan_body.reserve(scans_.size());
  for (const Scan& scan : scans_) {
    const Pose2 pose = scan.T_body_reference * T_reference_body;
    T_scan_body.push_back({Eigen::Rotation2Dd(pose.yaw_rad).toRotationMatrix(), pose.position_m()});
  }
  std::vector<Sight> sights(x_m.size(), Sight::kUnseen);
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    const Eigen::Vector2d point_m(x_m[i], y_m[i]), normal = normalAt(x_m, y_m, i);
    for (std::size_t k = scans_.size(); k-- > 0 && sights[i] != Sight::kSeen;) {  // Newest first: it usually sees most.
      const Placed& at = T_scan_body[k];
      const Eigen::Vector2d in_scan_m = at.rotation * point_m + at.position_m;
      if (isBack(scans_[k], in_scan_m, at.rotation * normal))
        sights[i] = Sight::kBackOfSeen;
      else if (looksAt(scans_[k], in_scan_m, margin_m))
        sights[i] = Sight::kSeen;
    }
  }
  return sights;
}

}  // namespace swiftlet::perception
