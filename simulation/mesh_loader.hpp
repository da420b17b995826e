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
  Color color = Color::Constant(0.7F);     ///< Colour of the materials, averaged over the triangles.
  std::vector<SurfaceMaterial> materials;  ///< One or more. An image is named as in the file.
  std::vector<std::uint16_t> material_of_triangle;
  /// Of the vertices in their images: (0, 0) is the top left corner and (1, 1) the bottom right one; (0, 0) where none
  /// is given.
  std::vector<Eigen::Vector2f> image_places;
  /// Files of materials (.mtl) that are not there. What has them is of one grey.
  std::vector<std::string> missing_materials;
};

/// In metres: a COLLADA file's unit is applied. Its `<up_axis>` is not, because Gazebo, for which these files were
/// made, uses the coordinates unchanged. `submesh` keeps only the node or mesh of that name; empty keeps all. The error
/// does not name the file.
tl::expected<Mesh, common::Message> loadMesh(const std::string& file, const std::string& submesh = {});

}  // namespace swiftlet::simulation
