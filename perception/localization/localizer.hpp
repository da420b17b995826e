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

#include "common/config_fwd.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/localization/global_search.hpp"
#include "perception/localization/local_map.hpp"
#include "perception/localization/particle_filter.hpp"
#include "perception/localization/scan_support.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

using common::LocalizationState;

struct LocalizerConfig {
  LocalizerConfig();

  MapFieldConfig field;
  ParticleFilterConfig particles;
  GlobalSearchConfig search;
  ScanSupportConfig support;
  LostTestConfig lost;

  double generation_distance_m = 0.20;
  double generation_turn_deg = 15.0;
  double odometry_share = 0.02;
  double odometry_deg_per_m = 0.5;
  double max_sigma_m = 1.0;

  double local_map_length_m = 12.0;
  double local_map_spacing_m = 0.15;
  int local_map_points = 160;
  int local_map_least_points = 40;
  double search_distance_m = 0.4;
  double point_weight = 0.15;
  double ambiguity = 0.01;
  double least_explained = 0.70;
  double confirm_distance_m = 1.0;
  double doubt_search_s = 0.5;
  double elsewhere_nats = 10.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct LocalizationInput {
  /// In the level frame of the body; its own T_odom_body is not read.
  const ProjectedScan& scan;
  common::Pose2 T_odom_body;  ///< An input without a finite one is passed over.
  /// Of the odometry since the last input, (x_m, y_m, yaw_rad) with the axes of the body then. One that is not finite
  /// says nothing: the step is taken for very uncertain.
  Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
  bool fresh = true;  ///< The odometry was not made of this scan: it may weigh.
  /// The odometry does not know how the vehicle came here from where it was; what it may be off by is added.
  bool interrupted = false;
};

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

/// A search of the whole map; heavy. A pure function of what it was given and of the map, which never changes: for any
/// thread.
struct LocalizationTask {
  struct Data;
  std::shared_ptr<Data> data;
};
struct LocalizationResult {
  struct Data;
  std::shared_ptr<const Data> data;
};
LocalizationResult run(const LocalizationTask& task);

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
