// The keep-out zones of a flight: those of the mission, which stay, and those of the operator, which can be removed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/polygon.hpp"

namespace swiftlet::autonomy {

/// One thread. A zone holds for planning, exploring, flights back along the trail and the reactive layer. A vehicle
/// that is inside a zone when it is made leaves it.
class KeepOutZones {
 public:
  explicit KeepOutZones(double hull_radius_m) : hull_radius_m_(hull_radius_m) {}

  enum class Owner { kMission, kOperator };
  /// A zone whose corners are all within 10 cm of a known one replaces it: a mission in a loop gives its zones
  /// again and again. Returns why the zone is refused: it is no polygon, or the hull would reach into it at home.
  /// Empty if it holds now.
  std::string add(const common::Polygon& zone, Owner owner, const Eigen::Vector2d& home_map_m,
                  const common::PlaceNames& names = {});
  /// The number of the operator's zones, which are gone now.
  std::size_t clearOperators();

  /// All zones; the same object until one is added or taken back.
  std::shared_ptr<const std::vector<common::Polygon>> zones() const { return zones_; }
  /// Points of their edges up to `range_m` away, in the level frame of the body; none of a zone that the body's centre
  /// is in, so that it can leave.
  std::vector<Eigen::Vector2d> edgesNear_level_m(const common::Pose2& T_map_body, double range_m) const;

 private:
  void publish();

  double hull_radius_m_;
  std::vector<common::Polygon> missions_, operators_;
  std::shared_ptr<const std::vector<common::Polygon>> zones_ = std::make_shared<const std::vector<common::Polygon>>();
};

}  // namespace swiftlet::autonomy
