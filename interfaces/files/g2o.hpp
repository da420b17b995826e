// Pose graphs as g2o writes them, one element a line, `#` begins a comment; metres and radians, quaternions x y z w:
//   VERTEX_SE2 id x y yaw                     EDGE_SE2 from to x y yaw (6 numbers of the information)
//   VERTEX_SE3:QUAT id x y z qx qy qz qw      EDGE_SE3:QUAT from to x y z qx qy qz qw (21 numbers of the information)
//   FIX id [id ...]
// The information is the upper triangle, row by row, of the inverse covariance of the error, which is the measurement's
// inverse times the relative pose of the estimate: in the plane (x, y, yaw), in space (x, y, z and the vector part of
// the unit quaternion whose w is not negative, which for small angles is half the rotation vector).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "interfaces/files/g2o_graph.hpp"
#include "interfaces/files/line_reader.hpp"

namespace swiftlet::interfaces {

struct G2oFile {
  std::variant<G2oGraph2D, G2oGraph3D> graph;
  /// Edges whose information, as the file has it, is not positive definite: no covariance belongs to it. Only with
  /// `ignore_cross_terms` there are any.
  std::size_t indefinite_edges = 0;
  std::vector<std::string> warnings;  ///< What was left out, one sentence a tag, with its first line.
};

/// Files compressed by gzip, bzip2 or xz are read as they are. Throws InputError with line and column for a line that
/// is not what its tag says, numbers that are not finite, a vertex that stands twice, an edge of a vertex to itself or
/// to one that is missing (a file without any vertex is sound: it has only edges), elements of the plane and of space
/// in one file, a file without edges, and, when all lines were read, for edges whose information is not positive
/// definite, with their number. Rotations are normalized.
G2oFile readG2o(const std::filesystem::path& file, const G2oOptions& options = {});
G2oFile readG2o(LineReader lines, const G2oOptions& options = {});

/// Equal graphs give equal bytes; numbers read back to the same bits, but for quaternions, which read back as they were
/// within rounding and are written with w >= 0. A graph with edges only is written so.
std::string toG2o(const G2oGraph2D& graph);
std::string toG2o(const G2oGraph3D& graph);

}  // namespace swiftlet::interfaces
