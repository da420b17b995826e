// A room for tests: 4 m by 3 m, its lower left corner at the origin, with a wall across that leaves a gap.
#pragma once

#include "common/occupancy_grid.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::evaluation {

/// An upright wall from one point to another, from the floor to 2.5 m.
inline simulation::Shape wall(const char* name, float x0, float y0, float x1, float y1) {
  simulation::Shape shape;
  shape.model = name;
  shape.vertices_world_m = {{x0, y0, 0}, {x1, y1, 0}, {x1, y1, 2.5F}, {x0, y0, 2.5F}};
  shape.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  return shape;
}

/// `gap_m` is the opening between the left and the right half, at the upper end of the wall at x = 2.
inline simulation::WorldModel smallWorld(float gap_m) {
  simulation::WorldModel world;
  world.shapes = {wall("south", 0, 0, 4, 0), wall("north", 0, 3, 4, 3), wall("west", 0, 0, 0, 3),
                  wall("east", 4, 0, 4, 3), wall("across", 2, 0, 2, 3 - gap_m)};
  simulation::Shape floor;
  floor.model = "floor";
  floor.vertices_world_m = {{-1, -1, 0}, {5, -1, 0}, {5, 4, 0}, {-1, 4, 0}};
  floor.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  world.shapes.push_back(floor);
  return world;
}

/// The true map of the room in the world's frame, drawn by hand: free inside, the outer walls occupied on the cells
/// just outside.
inline common::OccupancyGrid smallMap() {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  for (int y = -1; y <= 60; ++y)
    for (int x = -1; x <= 80; ++x) grid.set({x, y}, x < 0 || y < 0 || x == 80 || y == 60 ? 50 : -50);
  return grid;
}

}  // namespace swiftlet::evaluation
