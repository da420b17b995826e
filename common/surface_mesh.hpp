// Triangles with coloured vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

struct SurfaceMesh {
  struct Vertex {
    Eigen::Vector3f position_m;
    std::array<std::uint8_t, 3> rgb;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices of vertices, counter-clockwise from outside.
};

}  // namespace swiftlet::common
