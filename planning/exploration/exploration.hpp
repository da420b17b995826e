// Exploration: which frontiers there are, why some of them are not explored, and where to look from next. A planner
// finds the path there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/world/frontier.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::common {
class VoxelMap;
}

namespace swiftlet::planning {

/// A pose to look from.
struct Viewpoint {
  common::Pose2 pose_map;
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();  ///< The unknown place to be seen.
  double gain_m2 = 0.0;                                    ///< Unknown area expected to be seen.
  double utility = 0.0;                                    ///< The viewpoint with the greatest one is chosen.
  /// Unknown volume expected to be seen by the camera, of a viewpoint of the camera; 0 for one of the laser.
  double gain_m3 = 0.0;
};

/// An attempt to see an unknown place, and the place it was made from.
struct ExplorationAttempt {
  Eigen::Vector2d target_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  bool by_camera = false;  ///< The target is then straight ahead of the camera.
};

/// What a depth camera has seen so far.
struct SeenVolume {
  std::shared_ptr<const common::VoxelMap> voxels;  ///< In `map`; null before anything was seen.
  double camera_height_m = 1.0;                    ///< Of the camera at the height of flight.
};

struct ExplorationInput {
  std::shared_ptr<const CostMap> cost_map;  ///< Not null. Built with the clearance to be flown; has the grid's states.
  common::Pose2 pose_map;
  std::optional<Viewpoint> current;  ///< The viewpoint being flown to; kept unless another is clearly better.
  std::vector<ExplorationAttempt> attempts;
  std::optional<common::MapBounds> bounds;  ///< Frontiers outside are not explored, nor looked at from outside.
  /// Targets during whose approach the position became uncertain; frontiers near them are not explored.
  std::vector<Eigen::Vector2d> lost_map_m = {};
  /// Whether frontiers with too few walls around to know the position there are explored as well.
  bool leave_building = false;
  std::optional<Eigen::Vector2d> home_map_m = std::nullopt;  ///< Where the flight ends; nullopt: not known.
  SeenVolume volume = {};
};

struct ExplorationResult {
  std::vector<common::Frontier> frontiers;  ///< All frontiers, each with its reason; the open ones first, best first.
  std::optional<Viewpoint> next;            ///< nullopt when done, or when the vehicle cannot leave its place.
  bool done = false;                        ///< No frontier is open, and no volume is left for the camera.
  bool kept_current = false;                ///< `next` is the viewpoint that was given as current.
  double explored_area_m2 = 0.0;            ///< Area of the known free cells.
  /// For people, such as "4 open frontiers, next viewpoint (3.2, 1.5) for 2.0 m2".
  std::string reason;
};

enum class ExplorerKind { kUtility, kNearestFrontier, kTour, kCameraTour };

/// What a camera sees that is carried level: a pyramid of rays, ahead and down by its pitch.
struct CameraFrustum {
  double tangent_across = 0.0, tangent_up = 0.0;  ///< Of half of its fields of view.
  double pitch_down_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 0.0;
};

/// For people, such as "nearest frontier".
const char* toString(ExplorerKind kind);

struct ExplorerConfig {
  ExplorerKind kind = ExplorerKind::kUtility;
  double laser_range_m = 12.0;             ///< Range within which a viewpoint is expected to see.
  double laser_field_of_view_deg = 270.0;  ///< Angle centred on the heading that a viewpoint is expected to see.
  std::optional<CameraFrustum> camera = std::nullopt;  ///< Of the vehicle's depth camera, if it has one.

  void describe(common::config::Fields& fields);
};

/// Chooses the next viewpoint in the way of `config.kind`. A pure function, so that it can run as a job.
[[nodiscard]] ExplorationResult explore(const ExplorationInput& input, const ExplorerConfig& config);

/// The viewpoint that shows most for its travel time. Each frontier (Yamauchi 1997, used by Saeedi, section III-F) is
/// given the best place to see it from. Places are scored by the unknown area expected to be seen, by the travel time,
/// and by how well the laser fixes the pose there (Bachrach 2009, section 5.4).
[[nodiscard]] ExplorationResult exploreByUtility(const ExplorationInput& input, const ExplorerConfig& config);

/// The baseline (Yamauchi 1997, "A frontier-based approach for autonomous exploration", section 3.2): the place next to
/// a frontier, or as near to it as the hull fits, that is cheapest to reach. It faces the unknown, and is kept until it
/// is reached or its frontier is gone. Neither the gain there counts, nor whether the laser fixes the pose.
[[nodiscard]] ExplorationResult exploreNearestFrontier(const ExplorationInput& input, const ExplorerConfig& config);

/// A tour through places that together see all frontiers (Zhou 2021, "FUEL: fast UAV exploration using incremental
/// frontier structure and hierarchical planning", RA-L 6(2), sections IV and V; Zhang 2024, "FALCON: fast autonomous
/// aerial exploration using coverage path guidance", T-RO): the order of least travel time over the costs of the map,
/// on to home at its end. What lies near the way is taken along instead of being returned for. The first viewpoint is
/// kept while something is left to be seen from it and no other tour saves a stated share.
[[nodiscard]] ExplorationResult exploreByTour(const ExplorationInput& input, const ExplorerConfig& config);

/// The same tour with viewpoints of the camera in it, until nothing is left in the volume over the free floor that the
/// camera could see from the height of flight (the same sources; Bircher 2016, "Receding horizon next-best-view planner
/// for 3D exploration", ICRA, for the gain). Without a camera it is exploreByTour().
[[nodiscard]] ExplorationResult exploreByCameraTour(const ExplorationInput& input, const ExplorerConfig& config);

/// The attempt to record once the viewpoint was reached and what is seen from it is in the map.
inline ExplorationAttempt attemptFrom(const Viewpoint& viewpoint) {
  return {viewpoint.target_map_m, viewpoint.pose_map.position_m(), viewpoint.gain_m3 > 0.0};
}

}  // namespace swiftlet::planning
