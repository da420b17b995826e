// The reactive layer at the laser rate, under every intent (Saeedi, section III-G). Beams are smoothed by a sliding
// window and put into bins. The speed is limited so that the vehicle can stop. The vehicle retreats from obstacles that
// are unmapped or approaching.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/world/avoidance_status.hpp"
#include "planning/avoidance/avoidance_config.hpp"
#include "planning/avoidance/lookout.hpp"
#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

class ContactRisk;
struct NearPerson;
struct RetreatChoice;
struct Threat;

/// The speed from which the vehicle stops within the gap, braking after the delay: v t + v^2 / 2a = gap.
double stoppingSpeed_m_s(double gap_m, double deceleration_m_s2, double delay_s);

/// One scan, with the state at its time. The level frame is the body frame without roll and pitch.
struct AvoidanceInput {
  common::Time stamp;
  std::span<const Eigen::Vector2f> points_level_m;  ///< In order of bearing; points that are not finite are ignored.
  Eigen::Vector2d velocity_level_m_s = Eigen::Vector2d::Zero();
  /// The velocity that the intent requests; zero requests a stop.
  Eigen::Vector2d wanted_level_m_s = Eigen::Vector2d::Zero();
  common::Pose2 T_map_level;
  const Clearance* clearance = nullptr;                ///< May be null: then only `obstacles` are reasons to retreat.
  std::span<const common::DynamicObstacle> obstacles;  ///< Objects that the map does not explain, usually people.
  double age_s = 0.0;  ///< Of the scan when it was processed; the vehicle has moved on since.
  /// Standard deviation of the position in the map. Where it exceeds 0.15 m, the map does not show what is near, and
  /// the velocity may be wrong, too: the vehicle also retreats from mapped obstacles, when they are very near.
  double position_sigma_m = 0.0;
  /// Obstacles that only the 3D map has, where the beams pass above or below them. Each stands alone among the returns
  /// of what is behind it, so they are not smoothed: the map has made sure of them.
  std::span<const Eigen::Vector2f> map3d_points_level_m = {};
  /// Points of the edges of keep-out zones. The vehicle brakes before them, and no retreat leads across them, but they
  /// are never a reason to retreat.
  std::span<const Eigen::Vector2d> keep_out_points_level_m = {};
};

struct AvoidanceDecision {
  double speed_limit_m_s = 0.0;  ///< Limit along the wanted velocity, or along the present one if that is zero.
  /// Replaces the velocity of the intent if set. Fly it with `retreat_acceleration_m_s2`.
  std::optional<Eigen::Vector2d> retreat_velocity_level_m_s;
  double retreat_acceleration_m_s2 = 0.0;
  /// While people are about: the angle to turn so that the laser sees what matters most, see Lookout.
  std::optional<double> turn_rad;
  std::optional<Eigen::Vector2d> nearest_level_m;  ///< The nearest return, without keep-out zones.
  /// Why no course is free of people, with the figure; empty if one is. A descent is then no worse than a hover: it
  /// stays in the same place for less time.
  std::string nothing_free;
  common::AvoidanceStatus status;
};

/// The range of one sector, from the body origin; infinity if it has no return.
struct Bin {
  double bearing_rad = 0.0;  ///< Bearing of the middle of the sector.
  double range_m = 0.0;
  Eigen::Vector2d nearest_level_m = Eigen::Vector2d::Zero();  ///< The smoothed return that gave the range.
};

/// Keeps the hysteresis and the last decision. One thread; call once a scan.
///
///           danger: unmapped and near, or a person may be met         gone for 0.6 s
///   calm ------------------------------------------------> retreating -----------------> calm
///
/// The vehicle retreats when stopping is not enough: when an unmapped obstacle is within `retreat_distance_m` of the
/// hull, when leaving lowers the probability of meeting a person (ContactRisk), or when no course does
/// though somebody is likely met. For mapped, static obstacles it only
/// brakes, unless it flies at them too fast to stop, which no intent requests: it does so where its position is
/// corrected, or a gust pushes it. All distances are from the hull.
class Avoidance {
 public:
  using Config = AvoidanceConfig;
  using BinRange = AvoidanceBinRange;

  Avoidance(const Config& config, double hull_radius_m);

  [[nodiscard]] AvoidanceDecision update(const AvoidanceInput& input);

  /// The returns after the sliding window, and the sectors of a scan. Pure functions.
  static std::vector<Eigen::Vector2d> smoothed(const Config& config, std::span<const Eigen::Vector2f> points_level_m);
  static std::vector<Bin> bins(const Config& config, const std::vector<Eigen::Vector2d>& smoothed_level_m);
  /// Sectors with a point nearer than their return end at the point.
  static void shorten(const Config& config, std::span<const Eigen::Vector2f> points_level_m, std::vector<Bin>& bins);

 private:
  using Points = std::vector<Eigen::Vector2d>;

  std::vector<Threat> threats(const AvoidanceInput& input, const std::vector<Bin>& bins) const;
  bool cannotStopBefore(const Eigen::Vector2d& point_level_m, const Eigen::Vector2d& velocity_level_m_s) const;
  double speedLimit(const AvoidanceInput& input, const Eigen::Vector2d& direction, const Points& points,
                    double delay_s) const;
  double mappedGap_m(const AvoidanceInput& input, const Eigen::Vector2d& direction) const;
  bool isSeen(const Eigen::Vector2d& direction) const;
  std::vector<NearPerson> people(const AvoidanceInput& input) const;
  std::string whyLeaving(const std::vector<NearPerson>& people) const;
  struct Slowed {
    double speed_m_s = 0.0;
    double contact = 0.0;  ///< Probability that a person is met at that speed.
  };
  Slowed slowedFor(const ContactRisk& risk, const Eigen::Vector2d& velocity_level_m_s, const Eigen::Vector2d& ahead,
                   double intended_m_s, double latency_s) const;
  RetreatChoice retreat(const AvoidanceInput& input, const Points& points, const std::vector<Threat>& threats,
                        const std::vector<NearPerson>& people, const ContactRisk& risk, double latency_s) const;
  std::string whyNothingIsFree(const AvoidanceInput& input, const ContactRisk& risk, double least,
                               double latency_s) const;
  void look(const AvoidanceInput& input, const std::vector<Threat>& threats, std::vector<NearPerson> people,
            AvoidanceDecision& decision);
  bool isMapped(const AvoidanceInput& input, const Eigen::Vector2d& point_level_m) const;

  Config config_;
  double hull_radius_m_;
  bool retreating_ = false;
  common::Time danger_stamp_;
  std::string danger_;
  Lookout lookout_;
  std::optional<common::Time> people_seen_;  ///< When somebody walked about last.
  Eigen::Vector2d last_retreat_level_ = Eigen::Vector2d::Zero();
};

}  // namespace swiftlet::planning
