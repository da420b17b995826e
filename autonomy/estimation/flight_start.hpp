// The start of the estimate: the attitude of a vehicle that stands still, and the height of its body above the floor.
#pragma once

#include <optional>
#include <string>

#include "autonomy/estimation/heard_filter.hpp"
#include "autonomy/estimation/laser_pipeline.hpp"
#include "autonomy/estimation/start_view.hpp"
#include "common/event_log.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::autonomy {

/// One thread.
class FlightStart {
 public:
  /// `standing_height_m`: that of the body over the floor, if the mirror sees none.
  FlightStart(const LaserPipelineConfig& config, const common::LaserConfig& laser, double standing_height_m,
              bool uses_ahrs, common::EventLog& log)
      : uses_ahrs_(uses_ahrs),
        standing_height_m_(standing_height_m),
        view_(config, laser, standing_height_m),
        log_(log) {}

  /// See Estimator::withAttitude.
  common::ImuSample withAttitude(const common::ImuSample& sample, const perception::ErrorStateFilter& filter) const;
  void imuArrived(const common::ImuSample& sample);
  /// Starts the filter with a scan of the standing vehicle. Returns the height of its body over the floor, nullopt if
  /// the filter has not started.
  std::optional<double> start(const common::LaserScan& scan, const LaserPipeline& laser, HeardFilter& filter);
  /// False for a scan that was under way when the filter started: the filter has no pose for its time.
  bool isCovered(const common::LaserScan& scan) const { return scan.stamps.measured >= started_; }
  /// Keeps a scan of the vehicle at rest with its attitude.
  void look(const common::LaserScan& scan, const Eigen::Quaterniond& R_odom_body);
  /// Why a flight from where the vehicle stands would not know its height or position; empty if it would. See
  /// StartView::problem.
  std::string problem(common::Time now, bool position_known) const;

 private:
  void sayWaiting(common::Time now, std::string reason);

  bool uses_ahrs_;
  double standing_height_m_;
  StartView view_;
  std::optional<common::ImuSample> last_imu_;  ///< The last one with an attitude.
  bool imu_seen_ = false;
  bool waits_ = false;    ///< An event has said that the filter cannot start yet.
  common::Time started_;  ///< Time at which the filter started.
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
