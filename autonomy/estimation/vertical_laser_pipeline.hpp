// Makes the 3D map from the sweeps of a second laser whose scan plane stands upright. It needs no camera, and works
// outdoors. The sweeps are not matched: their poses come from the level laser, the altitude and the attitude.
//
//   sweep --> waits until the poses of its beams are known --> returns, each by the pose of its own time
//                --> SubmapStore (points, voxels), a job --> Map3dLayer
//
// As submaps hang on the key scans of the 2D map, a loop closure moves them. Source: Saeedi et al., section IV-B, whose
// vertical laser makes the 3D map in Case 2.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/arrivals/silence_watch.hpp"
#include "autonomy/estimation/map3d_publisher.hpp"
#include "common/config_fwd.hpp"
#include "common/disc.hpp"
#include "common/event_log.hpp"
#include "common/jobs.hpp"
#include "common/key_pose.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "common/world/map3d_layer.hpp"
#include "mapping3d/model/submap_store.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

struct VerticalLaserPipelineConfig {
  mapping3d::VoxelConfig voxels{.range_max_m = 8.0};
  mapping3d::SubmapConfig submaps{.cube_m = 0.03, .point_range_m = 8.0, .reach_m = 4.0};
  double body_radius_m = 0.3;
  double latency_s = 0.05;  ///< Declared time for drawing the sweeps that have come since the last job.

  void describe(common::config::Fields& fields);
};

/// What the estimator knows at the times of a sweep.
struct SweepSituation {
  int key = 0;                       ///< The key scan that the poses are relative to.
  perception::PoseAt T_key_body;     ///< For each time of the sweep.
  std::vector<common::Disc> people;  ///< In `map`.
};

struct VerticalLaserCounts {
  std::uint64_t sweeps = 0;    ///< Sweeps that arrived and were newer than those before.
  std::uint64_t skipped = 0;   ///< Sweeps that are repeated or late, or too many at once.
  std::uint64_t unplaced = 0;  ///< Sweeps at whose time no measurement supported the pose; they are left out.
  std::uint64_t drawn = 0;
};

/// One thread. Its jobs refer to it, so it cannot be moved and must outlive them.
class VerticalLaserPipeline {
 public:
  VerticalLaserPipeline(const VerticalLaserPipelineConfig& config, const common::LaserConfig& laser,
                        common::JobRunner& jobs, common::EventLog& log);
  VerticalLaserPipeline(const VerticalLaserPipeline&) = delete;
  VerticalLaserPipeline& operator=(const VerticalLaserPipeline&) = delete;

  /// A sweep that was not measured after the last one is counted and left out.
  void add(std::shared_ptr<const common::VerticalScan> sweep);

  /// First and last time of the sweep that is placed next; nullopt if no sweep waits.
  struct Interval {
    common::Time begin, end;
  };
  std::optional<Interval> next() const;
  /// Until then it is worth waiting for a scan of its time. Only if there is a next one.
  common::Time waitUntil() const;
  /// Places the next sweep; without a situation it is left out.
  void place(const std::optional<SweepSituation>& situation);
  /// Draws the placed sweeps, in a job, and detects that the laser sends nothing usable. To be called at every tick.
  void draw(const std::shared_ptr<const common::KeyPoses>& keys, common::Time now);

  /// See Map3dPublisher::layer.
  std::shared_ptr<const common::Map3dLayer> layer(const std::shared_ptr<const common::KeyPoses>& keys) {
    return publisher_.layer(keys);
  }
  const VerticalLaserCounts& counts() const { return counts_; }

 private:
  using Sweeps = std::vector<mapping3d::PlacedSweep>;

  VerticalLaserPipelineConfig config_;
  common::LaserConfig laser_;
  common::JobRunner& jobs_;
  SilenceWatch silence_;
  std::shared_ptr<mapping3d::SubmapStore> submaps_;  ///< Belongs to the job while one is outstanding.
  Map3dPublisher publisher_;
  std::deque<std::shared_ptr<const common::VerticalScan>> waiting_;  ///< In the order of their times.
  Sweeps placed_;
  std::optional<common::Time> last_measured_;
  bool any_fault_ = false;  ///< An event has said that a sweep cannot be used.
  VerticalLaserCounts counts_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
