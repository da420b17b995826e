// Localizes the flight in a given map: feeds perception::Localizer with the flight's scans, and runs its searches as
// jobs.
//
//   scan --> used either by the odometry or to weigh particles, never for both
//       \--> Localizer --> search of the whole map, a job --> common::Localization
//
// The vehicle does not fly by this pose, but by the map that it makes itself.
#pragma once

#include <optional>

#include "common/config_fwd.hpp"
#include "common/event_log.hpp"
#include "common/given_map.hpp"
#include "common/jobs.hpp"
#include "common/localization.hpp"
#include "perception/localization/localizer.hpp"
#include "perception/localization/scan_turns.hpp"
#include "perception/people/background_map.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

using common::GivenMap;

struct FlightLocalizerConfig {
  perception::LocalizerConfig localizer;
  double search_latency_s = 0.3;

  void describe(common::config::Fields& fields);
};

/// A scan with the estimator's results for it.
struct LocatedScan {
  const perception::ProjectedScan& scan;
  common::Pose2 T_odom_body;  ///< The filter's pose at its stamp.
  /// Covariance of the odometry since the previous scan, (x_m, y_m, yaw_rad) with the axes of the body.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  bool withheld = false;     ///< The odometry did not use it.
  bool interrupted = false;  ///< The odometry was lost and restarts with this scan.
};

/// One thread; searches are submitted to `jobs`. Deterministic.
class FlightLocalizer {
 public:
  FlightLocalizer(const GivenMap& map, const FlightLocalizerConfig& config, common::JobRunner& jobs,
                  common::EventLog& log);

  /// Replaces the present map: the state is that of a new localizer.
  void load(const GivenMap& map);
  /// The pose is searched again in the whole map.
  void forget();

  /// Whether the next scan, predicted at that pose, must be withheld from the odometry; see perception::ScanTurns.
  bool wantsScan(const common::Pose2& T_odom_body);
  void add(const LocatedScan& located, common::Time now);
  /// For a scan that is not used because it was taken too low. Its covariance and interruption are added to the next
  /// scan that is used.
  void passOver(const Eigen::Matrix3d& step_covariance, bool interrupted);

  const common::Localization& localization() const { return localization_; }
  /// The given map in the frame `map`; nullopt while the vehicle is not localized in it.
  std::optional<perception::GivenBackground> background(const common::Pose2& T_map_odom) const;

 private:
  void take(const perception::LocalizationEstimate& estimate, common::Time now);
  void submitSearch(common::Time now);

  FlightLocalizerConfig config_;
  common::JobRunner& jobs_;
  GivenMap map_;
  perception::Localizer localizer_;
  perception::ScanTurns turns_;
  int maps_ = 1;  ///< How many were given: the result of a search in an earlier one is discarded.
  struct {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    bool interrupted = false;
  } since_last_;  ///< Accumulated from the odometry since the last scan that was used.
  common::Localization localization_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
