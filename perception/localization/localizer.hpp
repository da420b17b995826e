// Where a vehicle is in a given map: found globally, followed, and doubted.
//
//               several places fit               one place, held over some way
//   kGlobal  <---------------------> kAmbiguous -------------------------------> kLocalized
//      |  (nothing fits, or too little was seen)      ^                              |
//      +----------------------------------------------|----------------------->      | the map no longer explains what
//                                                     |                              | is seen, or explains it much
//                                                   kLost <--------------------------+ better elsewhere
//
// Until it is localized, scans are kept in a local map and the whole of it is compared with the given map: the
// particles are drawn from all places where it fits (GlobalSearch), in proportion to its likelihood. Once a single
// place is left and holds while the vehicle goes on, particles follow it: a new generation per distance travelled, from
// scans that the odometry was not made of (Grzonka 2009, section V-C). Every scan is looked at for how much of it the
// map explains; that moves no particle.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/localization.hpp"
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
  common::Pose2 T_map_odom;  ///< Meaningful only when localized.
  common::Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of T_map_body: (x_m, y_m, yaw_rad) along the map's axes.
  double explained = 0.0;                                ///< Share of the scan that the map explains from there.
  int places = 0;                                        ///< That explain what was seen; 1 when localized.
  std::optional<LocalizationEvent> event;                ///< The state changed.
};

/// Deterministic. Not thread-safe. The work per scan is bounded, but a search of the whole map takes up to
/// some hundred milliseconds. Where that must not hold up the loop, `follow` leaves it to a task:
///
///   follow(scan) --> takeTask() --> run(task), in a job --> apply(result), some scans later
///
class Localizer {
 public:
  /// `T_map_grid` places the grid in the map frame. The map must have walls and free cells: see `whyUnusable`.
  Localizer(const common::OccupancyGrid& map, const common::Pose2& T_map_grid, const LocalizerConfig& config,
            std::uint64_t seed);
  ~Localizer();
  Localizer(Localizer&&) noexcept;
  Localizer& operator=(Localizer&&) noexcept;

  /// What makes a map useless for localization; empty when nothing does.
  static std::string whyUnusable(const common::OccupancyGrid& map);

  /// It is believed to be there, until what is seen says otherwise.
  void startAt(const common::Pose2& T_map_body, const Eigen::Matrix3d& covariance);

  /// Whether a scan taken at that pose should be kept from the odometry, to weigh particles. The local map is made of
  /// any scans: it is compared with the given map, not with the odometry.
  bool wantsFreshScan(const common::Pose2& T_odom_body) const;

  /// What one scan says, with the search it asks for.
  LocalizationEstimate add(const LocalizationInput& input);

  /// The same without the search.
  LocalizationEstimate follow(const LocalizationInput& input);
  /// The search that the last scan asks for; none while one that was taken has not been applied.
  std::optional<LocalizationTask> takeTask();
  /// What became of the task, as of the last scan. One that no longer fits, as the vehicle was carried or told a place
  /// meanwhile, changes nothing.
  LocalizationEstimate apply(const LocalizationResult& result);

  LocalizationState state() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
