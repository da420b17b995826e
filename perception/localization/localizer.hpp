// Localization in a given map: finds the pose globally, tracks it, and detects when it is lost.
//
//                 1                     2
//   kGlobal <------------> kAmbiguous -------> kLocalized
//                 3           ^ |                  |
//                           1 | | 4                | 5
//                             | v                  |
//                            kLost <---------------+
//
//   1  At least one place fits, but the pose is not confirmed.
//   2  One place is left, has been the only one over a metre of path, and agrees with the last scan, and the map
//      is not refuted.
//   3  No place fits, and the vehicle was never localized.
//   4  No place fits, and the vehicle was localized before.
//   5  The map explains too little of the scans, another place explains them much better, or the pose is too uncertain.
//
// startAt() leads from any state to kLocalized, forget() from any state to kLost or kGlobal.
//
// Until the vehicle is localized, its scans are collected in a local map. The whole local map is compared with the
// given map, and the particles are drawn from all places where it fits (GlobalSearch), in proportion to the likelihood.
// Once only one place is left and stays the only one over a metre of path, particles track the pose: a new
// generation is drawn per distance travelled, from scans that the odometry did not use (Grzonka 2009, section V-C).
// Every scan is also checked for the share that the map explains; this check moves no particle.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/localization.hpp"
#include "common/message.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/localization/localization_input.hpp"
#include "perception/localization/localization_task.hpp"
#include "perception/localization/localizer_config.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

using common::LocalizationState;

struct LocalizationEvent {
  common::Time stamp;
  LocalizationState state = LocalizationState::kGlobal;
  std::string reason;
};

struct LocalizationEstimate {
  LocalizationState state = LocalizationState::kGlobal;
  common::Pose2 T_map_odom;  ///< Valid only when localized.
  common::Pose2 T_map_body;
  /// Covariance of T_map_body: (x_m, y_m, yaw_rad) along the map's axes.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double explained = 0.0;                          ///< Share of the scan that the map explains at the pose.
  int places = 0;                                  ///< Number of places that explain the scans; 1 when localized.
  std::vector<common::PlaceCandidate> candidates;  ///< See common::Localization; `given` is the map frame.
  bool refuted = false;                            ///< The map is most likely that of another place.
  std::optional<LocalizationEvent> event;          ///< Set when the state changed.
};

/// Deterministic. Not thread-safe. The work per scan is bounded, but a search of the whole map can take a few hundred
/// milliseconds. To keep the search out of the loop, `follow` leaves it to a task:
///
///   follow(scan) --> takeTask() --> run(task), in a job --> apply(result), some scans later
///
class Localizer {
 public:
  /// `T_map_grid` is the pose of the grid in the map frame. The map must have walls and free cells: see `whyUnusable`.
  Localizer(const common::OccupancyGrid& map, const common::Pose2& T_map_grid, const LocalizerConfig& config,
            std::uint64_t seed);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// The reason why a map cannot be used for localization; nullopt if it can.
  static std::optional<common::Message> whyUnusable(const common::OccupancyGrid& map);

  /// Starts localized at a given pose, which later scans may refute.
  void startAt(const common::Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// Forgets the pose and all scans: kLost if it was localized before, and else as at the start.
  void forget();

  /// Whether a scan taken at that pose should be withheld from the odometry and weigh the particles instead. The local
  /// map may use all scans, because it is compared with the given map and not with the odometry.
  bool wantsFreshScan(const common::Pose2& T_odom_body) const;

  /// Processes one scan, including the search it requests: follow(), run() and apply() in one call.
  LocalizationEstimate add(const LocalizationInput& input);

  /// Processes one scan without the search.
  LocalizationEstimate follow(const LocalizationInput& input);
  /// The search requested by the last scan; nullopt without a request, or while an earlier result is pending.
  std::optional<LocalizationTask> takeTask();
  /// Applies the result of a search, to the state after the last scan. A result that is out of date, because the
  /// vehicle was carried or given a pose in the meantime, is ignored.
  LocalizationEstimate apply(const LocalizationResult& result);

  LocalizationState state() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
