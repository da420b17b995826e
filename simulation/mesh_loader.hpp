// Triangles of a mesh file, through assimp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "simulation/triangulate.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

struct Mesh {
  Triangles triangles;
  Color color = Color::Constant(0.7F);  ///< Colour of the materials, averaged over the triangles.
  std::vector<Color> colors;            ///< Of the materials, one or more.
  std::vector<std::uint16_t> color_of_triangle;
};

/// In metres: a COLLADA file's unit is applied. Its `<up_axis>` is not, because Gazebo, for which these files were
/// made, uses the coordinates unchanged. `submesh` keeps only the node or mesh of that name; empty keeps all. The error
/// is a sentence without the file's name.
tl::expected<Mesh, std::string> loadMesh(const std::string& file, const std::string& submesh = {});

}  // namespace swiftlet::simulation
