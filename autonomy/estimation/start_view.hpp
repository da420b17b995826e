// What the laser sees from where the vehicle stands: whether that can carry a flight.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "autonomy/estimation/laser_pipeline.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::autonomy {

/// One thread.
class StartView {
 public:
  /// `standing_height_m` is that of the body over the floor.
  StartView(const LaserPipelineConfig& config, const common::LaserConfig& laser, double standing_height_m);

  /// Keeps the newest scan of the standing vehicle; the rotation has no yaw.
  void add(const common::LaserScan& scan, const Eigen::Quaterniond& R_level_body);

  /// Why a flight from here would not know its height or position, for people; empty if it would. Where the position
  /// is known from another sensor, the height alone counts.
  std::string problem(common::Time now, bool position_known) const;

 private:
  perception::ProjectedScan projected() const;
  std::string heightProblem(const perception::ProjectedScan& view) const;
  std::string positionProblem(const perception::ProjectedScan& view) const;

  LaserPipelineConfig config_;
  common::LaserConfig laser_;
  double standing_height_m_;
  std::optional<common::LaserScan> scan_;
  Eigen::Quaterniond R_level_body_ = Eigen::Quaterniond::Identity();
};

}  // namespace swiftlet::autonomy
