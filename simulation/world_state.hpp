// The <state> of a world that Gazebo classic saved: where its models stood at that moment.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <sdf/World.hh>

#include "common/error.hpp"
#include "common/geometry.hpp"

namespace swiftlet::simulation {

/// Of a model or a link. Names of what is in a model are "model::nested::link".
struct EntityState {
  std::optional<common::Pose3> T_world_entity;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< Of each geometry of a model, about the geometry's own origin.
};

struct WorldState {
  common::SourceLocation source;
  std::map<std::string, EntityState> entities;
  std::set<std::string> deleted;            ///< Models that are gone.
  std::vector<common::Problem> insertions;  ///< Models that were added; they are not read.
  std::vector<common::Problem> warnings;    ///< Of names that the world does not have, and of further <state>s.

  const EntityState* of(const std::string& name) const;
};

/// The first <state> of the world, as Gazebo classic takes it; empty without one. `file` is for messages.
WorldState readState(const sdf::World& world, const std::string& file);

}  // namespace swiftlet::simulation
