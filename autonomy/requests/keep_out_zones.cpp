#include "autonomy/requests/keep_out_zones.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

/// One cell of the shipped map: the reactive layer keeps its margin to points this dense.
constexpr double kOutlineStep_m = 0.05;
/// A mission in a given map that repeats a zone gives it with the given map's present place.
constexpr double kSameCorner_m = 0.10;

bool isSame(const common::Polygon& a, const common::Polygon& b) {
  return std::equal(a.corners_map_m.begin(), a.corners_map_m.end(), b.corners_map_m.begin(), b.corners_map_m.end(),
                    [](const auto& corner, const auto& other) { return (corner - other).norm() <= kSameCorner_m; });
}

}  // namespace

std::string KeepOutZones::add(const common::Polygon& zone, Owner owner, const Eigen::Vector2d& home_map_m,
                              const common::PlaceNames& names) {
  if (const auto problem = problemOf(zone)) return problem->text();
  if (zone.signedDistance_m(home_map_m) < hull_radius_m_)
    return "the take-off place " + names.of(home_map_m) +
           " would be in it, expected one that leaves the path home free";
  std::vector<common::Polygon>& own = owner == Owner::kMission ? missions_ : operators_;
  const auto known = std::find_if(own.begin(), own.end(), [&](const auto& other) { return isSame(zone, other); });
  if (known != own.end() && *known == zone) return {};
  if (known != own.end())
    *known = zone;
  else
    own.push_back(zone);
  publish();
  return {};
}

std::size_t KeepOutZones::clearOperators() {
  const std::size_t count = operators_.size();
  operators_.clear();
  if (count > 0) publish();
  return count;
}

void KeepOutZones::publish() {
  auto all = std::make_shared<std::vector<common::Polygon>>(missions_);
  all->insert(all->end(), operators_.begin(), operators_.end());
  zones_ = std::move(all);
}

std::vector<Eigen::Vector2d> KeepOutZones::edgesNear_level_m(const common::Pose2& T_map_body, double range_m) const {
  std::vector<Eigen::Vector2d> points_level_m;
  const common::Pose2 T_body_map = T_map_body.inverse();
  for (const common::Polygon& zone : *zones_) {
    if (zone.contains(T_map_body.position_m())) continue;
    const auto& corners = zone.corners_map_m;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
      const double length_m = edge.norm();
      if (length_m <= 0.0) continue;
      // Of a long edge only the part within range is walked along.
      const double nearest_m = (T_map_body.position_m() - corners[i]).dot(edge) / length_m;
      const double from_m =
          std::clamp(std::floor((nearest_m - range_m) / kOutlineStep_m) * kOutlineStep_m, 0.0, length_m);
      const double to_m = std::clamp(nearest_m + range_m, 0.0, length_m);
      for (double at_m = from_m; at_m <= to_m; at_m += kOutlineStep_m) {
        const Eigen::Vector2d point = corners[i] + edge * (at_m / length_m);
        if ((point - T_map_body.position_m()).norm() <= range_m) points_level_m.push_back(T_body_map * point);
      }
    }
  }
  return points_level_m;
}

}  // namespace swiftlet::autonomy
