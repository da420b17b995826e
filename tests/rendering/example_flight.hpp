// An artificial flight through an artificial flat, to look at pictures and pages and to test them: the grid grows as
// the vehicle moves, with trail, plan, levels, frontiers of every reason and a mission tree.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/sensor_event.hpp"
#include "tests/rendering/example_room.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::testing {

class ExampleFlight {
 public:
  ExampleFlight();

  /// Flies on for `seconds` and returns the world then.
  std::shared_ptr<const common::World> advance(double seconds);
  /// Values of the next world; those that the flight itself changes are replaced when it flies on.
  test::Layers& layers() { return layers_; }

  /// The walls and boxes of the flat, 2.4 m high and lower.
  static ExampleRoom room();
  /// From now on the vehicle carries an RGB-D camera and makes a 3D map, with five frames a second.
  void carryCamera() { mapper_.emplace(room()); }
  /// Moves the key scans as a loop closure does; see ExampleMapper. It must carry a camera.
  void closeLoop(double step_m) { layers_.map3d = mapper_->bend(step_m); }

  /// A camera picture that changes with time.
  static common::CameraFrame cameraFrame(double time_s, int width_px, int height_px);

  /// Free and already seen.
  bool isKnownFree(const Eigen::Vector2d& point_map_m) const;
  void flyTo(const Eigen::Vector2d& goal_map_m) { layers_.mission.goal_map_m = goal_map_m; }

 private:
  bool isWall(const Eigen::Vector2d& point_map_m) const;
  void look();
  void lookInDepth();
  void move(double seconds);
  void describe();

  common::OccupancyGrid grid_ = common::makeOccupancyGrid(0.05);
  common::TrailRecorder trail_;
  std::optional<ExampleMapper> mapper_;
  common::Pose2 pose_;
  double time_s_ = 0.0;
  double mapped_s_ = -1.0;
  std::size_t waypoint_ = 0;
  test::Layers layers_;
};

}  // namespace swiftlet::testing
