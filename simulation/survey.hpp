// A robot on wheels with a level laser drives a given path through the world, so that a map can be made from its scans
// before the first flight. Its motion is exact and its scans are as noisy as those in flight; it has no odometry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/laser_scanner.hpp"

namespace swiftlet::simulation {

struct SurveyConfig {
  std::vector<double> path_world_m;
  std::string world;
  std::string laser = "sick_lms_291";
  double laser_height_world_m = 0.80;
  double speed_m_s = 0.8;
  double turn_deg_s = 45.0;
  int seed = 1;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct SurveyScan {
  common::LaserScan scan;      ///< Its stamp counts from the start of the drive.
  common::Pose2 T_world_body;  ///< True pose at that stamp, only for the scorer.
};

class SurveyDrive {
 public:
  /// The path has two points or more. `rays` must outlive it.
  SurveyDrive(const SurveyConfig& config, const common::LaserConfig& laser, const RayCaster& rays);

  /// The next scan; nullopt at the end of the path.
  std::optional<SurveyScan> next();
  double duration_s() const { return legs_.empty() ? 0.0 : legs_.back().end_s; }

 private:
  /// A turn on the spot or a straight line.
  struct Leg {
    common::Pose2 from;
    double distance_m = 0.0;
    double turn_rad = 0.0;
    double begin_s = 0.0, end_s = 0.0;
  };
  void addLeg(const Leg& leg, double duration_s);
  common::Pose2 poseAt(double time_s) const;
  common::Pose3 bodyAt(double time_s) const;

  SurveyConfig config_;
  common::LaserConfig laser_;
  const RayCaster& rays_;
  LaserScanner scanner_;
  std::vector<Leg> legs_;
  std::uint64_t frame_ = 0;
};

}  // namespace swiftlet::simulation
