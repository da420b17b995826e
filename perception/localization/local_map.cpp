#include "perception/localization/local_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "common/check.hpp"
#include "perception/localization/evenly_spread.hpp"

namespace swiftlet::perception {

using common::Pose2;

namespace {

/// Limits the scans kept while the vehicle turns on the spot: its path length does not grow, so none would be dropped.
constexpr std::size_t kMostScans = 200;

}  // namespace

void LocalMap::add(const Pose2& T_odom_body, const std::vector<Eigen::Vector2f>& points_body_m) {
  double path_length_m = 0.0;
  if (!key_scans_.empty())
    path_length_m = key_scans_.back().path_length_m +
                    (T_odom_body.position_m() - key_scans_.back().T_odom_body.position_m()).norm();
  key_scans_.push_back({T_odom_body, points_body_m, path_length_m});
  std::erase_if(key_scans_.back().points_body_m, [](const Eigen::Vector2f& point) { return !point.allFinite(); });
  while (path_length_m - key_scans_.front().path_length_m > length_m_ || key_scans_.size() > kMostScans)
    key_scans_.pop_front();
}

double LocalMap::length_m() const {
  return key_scans_.empty() ? 0.0 : key_scans_.back().path_length_m - key_scans_.front().path_length_m;
}

LocalMap::Whole LocalMap::whole(double spacing_m, std::size_t max_points) const {
  SWIFTLET_CHECK(!key_scans_.empty());
  Whole whole;
  whole.T_odom_middle = key_scans_[key_scans_.size() / 2].T_odom_body;
  std::unordered_set<std::uint64_t> taken;
  std::vector<Eigen::Vector2f> points;
  for (auto key = key_scans_.rbegin(); key != key_scans_.rend(); ++key) {
    const Pose2 T_middle_body = between(whole.T_odom_middle, key->T_odom_body);
    for (const Eigen::Vector2f& point_body : key->points_body_m) {
      const Eigen::Vector2d point = T_middle_body * point_body.cast<double>();
      const auto column = static_cast<std::int32_t>(std::floor(point.x() / spacing_m));
      const auto row = static_cast<std::int32_t>(std::floor(point.y() / spacing_m));
      const auto square =
          static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32 | static_cast<std::uint32_t>(row);
      if (taken.insert(square).second) points.push_back(point.cast<float>());
    }
  }
  const std::size_t kept = std::min(points.size(), max_points);
  for (std::size_t i = 0; i < kept; ++i) whole.points_middle_m.push_back(points[evenlySpread(i, kept, points.size())]);
  return whole;
}

}  // namespace swiftlet::perception
