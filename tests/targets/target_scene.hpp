// Rooms with coloured things, seen by a simulated RGB-D camera.
#pragma once

#include <string>
#include <vector>

#include "perception/targets/target_config.hpp"
#include "tests/simulation/rgbd_fixtures.hpp"

namespace swiftlet::perception::testing {

using simulation::Color;

inline const Color kRed(0.85F, 0.08F, 0.08F), kGreen(0.08F, 0.65F, 0.15F), kOrange(0.9F, 0.45F, 0.08F);

/// A box of `side_m` about `middle_m`, of one colour.
inline simulation::Shape cube(const Eigen::Vector3d& middle_m, double side_m, const Color& color) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * side_m);
  simulation::Shape shape = simulation::boxShape("cube", middle_m - half, middle_m + half);
  shape.color = color;
  shape.pattern = simulation::Pattern::kBlank;
  return shape;
}

/// A grey wall 4 m ahead of the origin and the floor 1 m below it, with these things before them.
inline simulation::WorldModel roomWith(const std::vector<simulation::Shape>& things) {
  simulation::WorldModel world = simulation::wallAhead(4.0);
  world.shapes.push_back(simulation::boxShape("floor", {-10.0, -10.0, -1.1}, {10.0, 10.0, -1.0}));
  world.shapes.back().pattern = simulation::Pattern::kBlank;
  world.shapes.insert(world.shapes.end(), things.begin(), things.end());
  return world;
}

/// The camera as it flies, except that it is at the origin of the body and looks straight ahead.
inline common::RgbdCameraConfig flyingCamera() {
  common::RgbdCameraConfig camera;
  camera.mount = {};
  return camera;
}

inline std::vector<TargetClassConfig> redAndGreen() {
  return {{.name = "red", .hue_deg = 0.0}, {.name = "green", .hue_deg = 127.0, .hue_tolerance_deg = 20.0}};
}

}  // namespace swiftlet::perception::testing
