// People in the world. They walk a given path, cross the vehicle's path where that is free, or follow the vehicle until
// something blocks them. They never yield to the vehicle.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

/// The state of the vehicle that a walker crosses or follows.
struct WalkedAround {
  Eigen::Vector3d position_world_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world_m_s = Eigen::Vector3d::Zero();
  bool airborne = false;
};

class Walker {
 public:
  /// `number` names its random stream. `rays` must outlive it.
  Walker(const WalkerConfig& config, int seed, std::size_t number, double floor_world_m, double hull_radius_m,
         const RayCaster& rays);

  /// nullopt while it is not in the world.
  const std::optional<Actor>& actor() const { return actor_; }
  void step(common::Time now, const WalkedAround& vehicle, double step_s);

 private:
  void appearAt(const Eigen::Vector2d& position_world_m);
  void walkPath(double walked_m);
  /// The path length walked after that time, with the speeds and the pauses of each part of the path.
  double walkedAfter_m(double time_s) const;
  void cross(double now_s, const WalkedAround& vehicle);
  bool planCrossing(const WalkedAround& vehicle);
  void follow(const WalkedAround& vehicle, double step_s);
  /// Whether a person walking straight from one point to the other touches nothing.
  bool freePath(const Eigen::Vector2d& from_world_m, const Eigen::Vector2d& to_world_m) const;

  WalkerConfig config_;
  int seed_;
  std::size_t number_;
  double floor_world_m_;
  double hull_radius_m_;
  const RayCaster& rays_;
  std::optional<Actor> actor_;
  std::vector<Eigen::Vector2d> path_world_m_;  // For kFollow: the part of the vehicle's trail that is still ahead.
  double path_start_s_ = 0.0;
  double next_crossing_s_ = 0.0;
  std::uint64_t crossings_ = 0;
};

}  // namespace swiftlet::simulation
