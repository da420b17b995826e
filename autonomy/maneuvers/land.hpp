// Land: done when the vehicle stands on the ground. In the air it cannot fail.
//
//   stop --> look beyond --> choose a place --> fly there --> descend
//                             |  none, or no position      ^ or where it is, if it does not get there
//                             +----------------------------+
//
// The place is the nearest one where the hull stands on one level, clear of the edges of tables and steps
// (planning/costs/landing_place.hpp). The beams that look down have seen only the trail: where it ends, the vehicle
// first flies a hull's width on to see whether the floor goes on there too.
#pragma once

#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "autonomy/maneuvers/path_flight.hpp"

namespace swiftlet::autonomy {

class Land final : public Maneuver {
 public:
  Land(const common::LandIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  std::optional<Eigen::Vector2d> goal_map_m() const override { return place_map_m_; }
  const PathFlight* path() const override { return &flight_; }
  Eigen::Vector2d wantedVelocity_map_m_s(const common::VehicleState&) const override {
    return flight_.wantedVelocity_map_m_s();
  }

 private:
  enum class Phase { kStops, kLooksBeyond, kFliesThere, kDescends };

  void begin(const ManeuverInput& input);
  void choose(const ManeuverInput& input);
  void approach(const ManeuverInput& input);
  void descend(common::Time now, const std::string& reason);

  ManeuverSetup setup_;
  PathFlight flight_;
  tl::expected<void, std::string> commanded_;
  Phase phase_ = Phase::kStops;
  std::optional<common::Time> since_;                     ///< When the landing began.
  Eigen::Vector2d here_map_m_ = Eigen::Vector2d::Zero();  ///< Where it stopped to land; not in Phase::kStops.
  std::optional<Eigen::Vector2d> place_map_m_;            ///< Where it flies to; nullopt before it is chosen.
  std::string no_path_;                                   ///< Why there is no path to the place; empty if it has one.
};

}  // namespace swiftlet::autonomy
