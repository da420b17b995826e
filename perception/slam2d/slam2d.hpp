// Graph SLAM in the plane (Grzonka 2009, section V-D): key scans are nodes, matches are edges, loops are sought where
// the projected uncertainty allows, and the map is an occupancy grid drawn from the scans at their best poses.
//
// In flight each scan costs a fraction of a millisecond: a key scan is matched to the older key scans around it, which
// bounds the drift inside known area, and drawn into the grid. What is heavy (loop search, optimization, drawing the
// grid anew) is a value: `takeTask` hands it out, `run` computes it anywhere, `apply` takes the result in.
//
//   addScan --> key scan --> takeTask() --> run(task) on any thread --> apply(result)
//
// Frames: the poses given are T_odom_body, continuous. The map frame is that of the grid; T_map_odom jumps with a local
// correction (millimetres, at a key scan) and with a loop closure (apply).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "optimization/pose_graph_2d.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"

namespace swiftlet::perception {

/// How scans are drawn into the grid.
struct GridDrawingConfig {
  double resolution_m = 0.05;
  int hit_steps = 18;
  int free_steps = 6;
  int max_steps = 70;
  double max_hit_range_m = 20.0;
  double max_free_range_m = 10.0;
  double max_height_above_m = 0.25;
  double max_height_below_m = 0.25;
  double slice_height_m = 0.05;
  int fade_steps = 1;
  double fade_height_m = 0.10;
  double slow_fade_height_m = 0.25;
  int slow_fade_scans = 4;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// When a loop is sought and when it is believed.
struct LoopClosureConfig {
  double spacing_m = 1.0;
  double max_sigma_m = 4.0;
  double min_window_m = 0.5;
  double min_window_deg = 10.0;
  double max_window_deg = 40.0;
  int query_scans = 5;
  int reference_scans = 9;
  int max_candidates = 4;
  double resolution_m = 0.04;
  double angular_resolution_deg = 0.5;
  double min_quality = 0.60;
  double min_fine_quality = 0.60;
  double max_ambiguity = 0.90;
  double distinct_m = 0.4;
  double distinct_deg = 12.0;
  double max_seen_through = 0.03;
  double max_edge_sigmas = 4.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct Slam2dConfig {
  CorrelativeMatcherConfig matcher;
  GridDrawingConfig grid;
  LoopClosureConfig loops;
  optimization::PoseGraphConfig graph;
  double key_distance_m = 0.4;
  double key_rotation_deg = 25.0;
  double key_time_s = 2.0;
  double level_tilt_deg = 2.0;
  double reuse_distance_m = 0.25;
  double reuse_rotation_deg = 20.0;
  double draw_distance_m = 0.10;
  double draw_rotation_deg = 6.0;
  double draw_time_s = 0.25;
  bool live_map = true;
  int scans_per_key = 16;
  double local_radius_m = 4.0;
  double local_sigma_m = 0.10;
  int local_scans = 10;
  double local_window_m = 0.15;
  double local_window_deg = 3.0;
  double edge_sigma_m = 0.01;
  double edge_sigma_deg = 0.15;

  void describe(common::config::Fields& fields);
};

/// What adding a scan did.
struct SlamUpdate {
  bool key_scan = false;     ///< It became a node of the graph.
  bool drawn = false;        ///< The grid changed.
  common::Pose2 T_map_body;  ///< Of the scan, corrected.
};

/// What ties two key scans: a match, or the motion between them.
struct SlamEdge {
  int from = 0;
  int to = 0;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< Of (x_m, y_m, yaw_rad) in the frame of `from`.
  bool loop = false;
};

struct LoopClosure {
  int from = 0;  ///< Key scans.
  int to = 0;
  common::Pose2 T_from_to;
  double quality = 0.0;
  double shift_m = 0.0;  ///< How far the closure lies from what was believed.
};

/// Work to be run elsewhere. Holds only shared immutable data; cheap to copy.
struct SlamTask {
  struct Data;
  std::shared_ptr<const Data> data;
};

struct SlamResult {
  struct Data;
  std::shared_ptr<const Data> data;
  std::vector<LoopClosure> accepted;  ///< Loops closed, for the record.
};

/// Pure function of the task; safe on any thread.
SlamResult run(const SlamTask& task);

struct SlamCounts {
  std::uint64_t scans = 0;
  std::uint64_t ignored_scans = 0;  ///< Out of order, or without a finite pose.
  std::uint64_t key_scans = 0;
  std::uint64_t local_failures = 0;  ///< Scans that should have matched older ones, but did not.
  std::uint64_t loop_candidates = 0;
  std::uint64_t loops_closed = 0;
  std::uint64_t loops_taken_back = 0;  ///< Of those, closures that later ones contradicted.
};

/// Single-threaded; the values it hands out are safe anywhere.
class Slam2d {
 public:
  explicit Slam2d(const Slam2dConfig& config);
  ~Slam2d();
  Slam2d(Slam2d&&) noexcept;
  Slam2d& operator=(Slam2d&&) noexcept;

  /// `T_odom_body`: the filter's pose at the scan's stamp. `covariance_since_last`: of the motion since the last scan
  /// given here, of the additive errors (x_m, y_m, yaw_rad) in the body frame of that last scan.
  SlamUpdate addScan(const ProjectedScan& scan, const common::Pose2& T_odom_body,
                     const Eigen::Matrix3d& covariance_since_last);

  /// Takes odom to map.
  common::Pose2 T_map_odom() const;
  /// The key scan (of keyPoses()) that the last scan is known by, and where it stands relative to it.
  int anchor() const;
  common::Pose2 T_anchor_body() const;
  /// The height over the take-off floor that the map shall be of; at first that of the body in the first scan.
  /// True when the map is another one now.
  bool setFlightHeight(double height_m);
  /// What may touch the hull at flight height, as known now; tiles are shared, cheap.
  common::OccupancyGrid snapshot();

  /// Heavy work, when there is any and none is outstanding.
  [[nodiscard]] std::optional<SlamTask> takeTask();
  /// The last work, when no more scans come: the graph as a whole. None may be outstanding.
  [[nodiscard]] std::optional<SlamTask> takeLastTask();
  /// Takes the result of the outstanding task; true when T_map_odom or the grid changed.
  bool apply(const SlamResult& result);

  const SlamCounts& counts() const;
  struct KeyPose {
    common::Time stamp;
    common::Pose2 T_map_body;
  };
  /// Every key scan at its best pose so far.
  std::vector<KeyPose> keyPoses() const;
  /// What they are tied by, as indices into keyPoses().
  const std::vector<SlamEdge>& edges() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
