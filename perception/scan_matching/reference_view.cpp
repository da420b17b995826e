#include "perception/scan_matching/reference_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Bins between two neighbouring beams count as seen if the beams are at most this far apart.
constexpr int kJoinedBins = 5;
/// The view ends at a gap of this many degrees without an end point.
constexpr int kEndBins = 20;
/// Points up to this far behind the end points count as seen, because walls are rough and poses err.
constexpr double kBehind_m = 0.15;

}  // namespace

int ReferenceView::binOf(double angle_rad) {
  const auto bin = static_cast<int>(std::floor((angle_rad + std::numbers::pi) * (kBins / (2.0 * std::numbers::pi))));
  return std::clamp(bin, 0, kBins - 1);
}

void ReferenceView::add(const std::vector<Eigen::Vector2f>& points_body_m, const Pose2& T_reference_body) {
  Scan scan;
  scan.T_body_reference = T_reference_body.inverse();
  std::array<float, kBins> ends_m{};
  const auto wrapped = [](int bin) { return static_cast<std::size_t>((bin + kBins) % kBins); };
  int last_bin = 0;
  float last_m = 0.0F;
  for (const Eigen::Vector2f& point : points_body_m) {
    const float range_m = point.norm();
    const int bin = binOf(std::atan2(point.y(), point.x()));
    int step = bin - last_bin;
    if (step > kBins / 2) step -= kBins;
    if (step < -kBins / 2) step += kBins;
    const auto reach = [&](int at, float to_m) { ends_m[wrapped(at)] = std::max(ends_m[wrapped(at)], to_m); };
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
  const auto bin = static_cast<std::size_t>(binOf(std::atan2(point_m.y(), point_m.x())));
  const double range_m = point_m.norm();
  return range_m <= static_cast<double>(scan.seen_to_m[bin]) + kBehind_m &&
         range_m * static_cast<double>(scan.sine_to_end[bin]) >= margin_m;
}

std::vector<bool> ReferenceView::sees(std::span<const float> x_m, std::span<const float> y_m,
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
  std::vector<bool> seen(x_m.size(), false);
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    for (std::size_t k = scans_.size(); k-- > 0 && !seen[i];) {  // Newest first: it usually sees most.
      const Eigen::Vector2d there_m =
          T_scan_body[k].rotation * Eigen::Vector2d(x_m[i], y_m[i]) + T_scan_body[k].position_m;
      seen[i] = looksAt(scans_[k], there_m, margin_m);
    }
  }
  return seen;
}

}  // namespace swiftlet::perception
