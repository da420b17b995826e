// Where the nose points while people are about. The laser does not see all round: what is behind it is not empty, it is
// unknown, and the more so the longer nobody looked and the farther somebody could come from there. The vehicle turns
// so that what remains unseen matters least: towards a wall, or where nobody could have come since the last look.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "planning/avoidance/contact_risk.hpp"
#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

/// The surroundings at one scan.
struct LookoutInput {
  common::Time stamp;
  common::Pose2 T_map_level;
  const Clearance* clearance;          ///< May be null: then everything is open.
  std::span<const NearPerson> people;  ///< In the level frame.
  Eigen::Vector2d course_level_m_s;    ///< Where it flies to; zero if it stands.
};

/// One thread; call once a scan.
class Lookout {
 public:
  Lookout(double field_of_view_deg, double hull_radius_m);

  /// Takes note of what the scan sees. The turn that brings what matters most into the field of view; zero to stay.
  double turn_rad(const LookoutInput& input);

 private:
  /// Directions of 10 deg, in the map.
  static constexpr int kDirections = 36;

  double weightOf(const LookoutInput& input, int direction) const;
  bool sees(double bearing_level_rad, double margin_rad) const;

  double half_field_rad_;
  double hull_radius_m_;
  std::array<common::Time, kDirections> seen_{};
  double aim_map_rad_ = 0.0;  ///< The heading it turned to last.
};

}  // namespace swiftlet::planning
