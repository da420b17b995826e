// Survey: flies over an area in lanes along its longest edge, so that the sensor sees all of it. Places that are not
// free are moved aside by up to half a lane, or left out.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "autonomy/maneuvers/table.hpp"
#include "autonomy/maneuvers/tour.hpp"
#include "common/geometry.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {
namespace {

/// Between two places of a lane: a lane bends around what is narrower.
constexpr double kStep_m = 0.4;
/// Share of the strip in view that the next lane sees too.
constexpr double kOverlap = 0.4;
/// Without a camera: the laser sees farther than rooms are wide, and the floor that its mirror sees is a line.
constexpr double kWithoutCamera_m = 1.0;
constexpr double kLeastSpacing_m = 0.3;  ///< Denser lanes show no more and take too long.

/// The width of the floor where the lower edge of the picture meets it, less the overlap.
double spacingFor_m(const common::RgbdCameraConfig& camera, double height_m) {
  const Eigen::Vector3d axis = camera.mount.pose().rotation * Eigen::Vector3d::UnitX();
  const double half_rad = 0.5 * camera.field_of_view_deg * common::kRadPerDeg;
  const double half_vertical_rad = std::atan(std::tan(half_rad) * camera.height_px / camera.width_px);
  const double down_rad = std::clamp(std::asin(-axis.z()) + half_vertical_rad, 0.05, 1.5);
  const double ahead_m = std::max(camera.range_min_m, (height_m + camera.mount.z_m) / std::sin(down_rad));
  return std::max(kLeastSpacing_m, (1.0 - kOverlap) * 2.0 * ahead_m * std::tan(half_rad));
}

/// The edge along which the lanes lie.
Eigen::Vector2d longestEdge(const common::Polygon& area) {
  Eigen::Vector2d longest = Eigen::Vector2d::Zero();
  const auto& corners = area.corners_map_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  return longest.normalized();
}

/// The places inside on the line through `origin`, both ends included.
std::vector<Eigen::Vector2d> laneIn(const common::Polygon& area, const Eigen::Vector2d& origin,
                                    const Eigen::Vector2d& along, double length_m) {
  std::vector<Eigen::Vector2d> places;
  const int count = std::max(1, static_cast<int>(std::ceil(length_m / kStep_m)));
  for (int i = 0; i <= count; ++i) {
    const Eigen::Vector2d place = origin + along * (length_m * i / count);
    if (area.contains(place)) places.push_back(place);
  }
  return places;
}

class Survey final : public Tour {
 public:
  Survey(const common::SurveyIntent& intent, const ManeuverSetup& setup);

 private:
  std::vector<Eigen::Vector2d> lay(const planning::CostMap& map, const ManeuverInput& input) override;
  std::optional<Eigen::Vector2d> standFor(const planning::CostMap& map,
                                          const Eigen::Vector2d& place_map_m) const override;
  std::string doing(const ManeuverInput&) const override { return "surveying"; }

  common::SurveyIntent intent_;
  double spacing_m_;
};

Survey::Survey(const common::SurveyIntent& intent, const ManeuverSetup& setup)
    : Tour(setup, "survey an area", intent.mode, 0.25), intent_(intent) {
  if (intent.height_m) setup.memory.cruise_height_m = *intent.height_m;
  spacing_m_ = intent.spacing_m.value_or(
      setup.camera != nullptr ? spacingFor_m(*setup.camera, setup.memory.cruise_height_m) : kWithoutCamera_m);
}

std::vector<Eigen::Vector2d> Survey::lay(const planning::CostMap&, const ManeuverInput& input) {
  const Eigen::Vector2d along = longestEdge(intent_.area), across(-along.y(), along.x());
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector2d& corner : intent_.area.corners_map_m) {
    const Eigen::Vector2d at(corner.dot(along), corner.dot(across));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const double width_m = high.y() - low.y(), length_m = high.x() - low.x();
  const int lanes = std::max(1, static_cast<int>(std::ceil(width_m / spacing_m_)));
  // The vehicle begins at the nearer side and the nearer end.
  const Eigen::Vector2d here(input.position_map_m().dot(along), input.position_map_m().dot(across));
  const bool from_high = std::abs(here.y() - high.y()) < std::abs(here.y() - low.y());
  bool backwards = std::abs(here.x() - high.x()) < std::abs(here.x() - low.x());
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < lanes; ++i, backwards = !backwards) {
    const double share = (i + 0.5) / lanes;
    const double at_m = low.y() + (from_high ? 1.0 - share : share) * width_m;
    // 1 micrometre inside, because contains() is undecided on an edge.
    std::vector<Eigen::Vector2d> lane =
        laneIn(intent_.area, along * (low.x() + 1e-6) + across * at_m, along, length_m - 2e-6);
    if (backwards) std::reverse(lane.begin(), lane.end());
    places.insert(places.end(), lane.begin(), lane.end());
  }
  return places;
}

/// The vehicle stops where a lane ends at an obstacle: where it has room for that, if there is room.
std::optional<Eigen::Vector2d> Survey::standFor(const planning::CostMap& map,
                                                const Eigen::Vector2d& place_map_m) const {
  const double reach_m = 0.5 * spacing_m_;
  const auto roomy = planning::nearestPlace(map, place_map_m, reach_m, [&](common::CellIndex cell) {
    return map.costAt(cell) != planning::CostMap::kLethal && hasRoomToStop(map, cell);
  });
  return roomy ? roomy : planning::nearestFree(map, place_map_m, reach_m);
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::SurveyIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Survey>(intent, setup);
}

}  // namespace swiftlet::autonomy
