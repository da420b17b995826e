// Doors: upright boxes that stand in the world while they are closed, and are nowhere while they are open.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/time.hpp"
#include "simulation/actor.hpp"

namespace swiftlet::simulation {

struct DoorConfig {
  std::string name = {};
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_deg = 0.0;
  double width_m = 0.9;
  double height_m = 2.0;
  double thickness_m = 0.05;
  /// Times at which it closes, opens, closes and so on.
  std::vector<double> closed_s = {};
  double closed_share = 0.0;  ///< Of the seeds, in which it is closed all the time.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// It does not crush: a door that should close waits until every vehicle is kRoom_m away.
class Door {
 public:
  Door(const DoorConfig& config, double floor_world_m);

  const std::string& name() const { return config_.name; }
  bool isClosed() const { return is_closed_; }
  /// Where it stands while it is closed.
  const Actor& actor() const { return actor_; }
  /// Call in the order of time. `hulls` are those of all vehicles.
  void step(common::Time now, std::span<const Actor> hulls);

  /// A vehicle at walking speed can stop before a door that closes so far ahead of it.
  static constexpr double kRoom_m = 0.5;

 private:
  bool shouldBeClosed(double now_s) const;
  bool hasRoom(std::span<const Actor> hulls) const;

  DoorConfig config_;
  Actor actor_;
  bool is_closed_ = false;
};

}  // namespace swiftlet::simulation
