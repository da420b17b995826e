// Where the flight is in a map it was given: perception::Localizer fed with the flight's scans, its searches as jobs.
//
//   scan --> the odometry, or kept from it to weigh particles, never both
//       \--> Localizer --> search of the whole map, a job --> common::Localization
//
// What is found steers nothing: the vehicle flies by the map it makes itself.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/localization/localizer.hpp"
#include "perception/localization/scan_turns.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

/// A map of the place that was made before.
struct GivenMap {
  std::shared_ptr<const common::OccupancyGrid> grid;  ///< Usable: see perception::Localizer::whyUnusable.
  common::Pose2 T_given_grid;                         ///< Places the grid in `given`, the frame of the map's file.
  std::uint64_t seed = 1;                             ///< Of the particles.
};

struct FlightLocalizerConfig {
  perception::LocalizerConfig localizer;
  double search_latency_s = 0.3;

  void describe(common::config::Fields& fields);
};

/// A scan as the estimator leaves it.
struct LocatedScan {
  const perception::ProjectedScan& scan;
  common::Pose2 T_odom_body;  ///< At its stamp, by the filter.
  /// Of the odometry since the scan before, (x_m, y_m, yaw_rad) with the axes of the body.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  bool withheld = false;     ///< From the odometry.
  bool interrupted = false;  ///< The odometry lost the thread and began anew with this scan.
};

/// One thread; searches go to the runner it is given. Deterministic.
class FlightLocalizer {
 public:
  FlightLocalizer(const GivenMap& map, const FlightLocalizerConfig& config, common::JobRunner& jobs);

  /// Whether the next scan, expected at that pose, is to be kept from the odometry; see perception::ScanTurns.
  bool wantsScan(const common::Pose2& T_odom_body);
  void add(const LocatedScan& located, common::Time now);
  /// A scan that is not looked at, as it was taken too low: what the odometry did meanwhile counts with the next.
  void passOver(const Eigen::Matrix3d& step_covariance, bool interrupted);

  const common::Localization& localization() const { return localization_; }
  std::vector<common::Event> takeEvents();

 private:
  void take(const perception::LocalizationEstimate& estimate, common::Time now);
  void submitSearch(common::Time now);

  FlightLocalizerConfig config_;
  common::JobRunner& jobs_;
  perception::Localizer localizer_;
  perception::ScanTurns turns_;
  struct {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    bool interrupted = false;
  } since_last_;  ///< Of the odometry, since the last scan that was looked at.
  common::Localization localization_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
