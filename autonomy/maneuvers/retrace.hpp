// Retrace: flies back along a path that was flown before. It needs no map and no plan, so it works where the map or the
// position is unreliable; the reactive layer brakes as everywhere. It fails before a keep-out zone that was made
// after the trail, and where an obstacle stays for long.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

class Retrace final : public Maneuver {
 public:
  /// The intent's lost_on_the_way_to_map_m is remembered, so that exploring leaves it.
  Retrace(const common::RetraceIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;
  std::optional<Eigen::Vector2d> goal_map_m() const override;
  Eigen::Vector2d wantedVelocity_map_m_s(const common::VehicleState& state) const override;

 private:
  std::span<const Eigen::Vector2d> remaining(const Eigen::Vector2d& from_map_m) const;
  void follow(const ManeuverInput& input);
  Eigen::Vector3d atItsHeight(const Eigen::Vector2d& point_map_m) const;
  bool isStuck(const ManeuverInput& input);
  void keepOut(const std::vector<common::Polygon>& zones);

  ManeuverSetup setup_;
  common::RetraceIntent intent_;
  bool following_ = false;
  bool cut_ = false;  ///< The path was cut before a keep-out zone.
  struct Moved {
    common::Time at;
    Eigen::Vector2d to_map_m;
  };
  std::optional<Moved> moved_;  ///< When it last got on.
};

}  // namespace swiftlet::autonomy
