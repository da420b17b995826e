// Pose graphs as g2o writes them, one element a line, `#` begins a comment; metres and radians, quaternions x y z w:
//   VERTEX_SE2 id x y yaw                     EDGE_SE2 from to x y yaw (6 numbers of the information)
//   VERTEX_SE3:QUAT id x y z qx qy qz qw      EDGE_SE3:QUAT from to x y z qx qy qz qw (21 numbers of the information)
//   FIX id [id ...]
// The elements of TORO are read as well, those of its older form without a number too:
//   VERTEX2 id x y yaw                        EDGE2 from to x y yaw (information: xx xy yy yawyaw xyaw yyaw)
//   VERTEX3 id x y z roll pitch yaw           EDGE3 from to x y z roll pitch yaw (21 numbers, row by row)
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
  /// Edges whose information in the file is not positive definite, so that no covariance belongs to it. Without
  /// `ignore_cross_terms` such a file is refused, so the count is 0.
  std::size_t indefinite_edges = 0;
  std::vector<std::string> warnings;  ///< What was left out: one sentence for each tag, with its first line.
};

/// Files compressed by gzip, bzip2 or xz are decompressed. Throws InputError with line and column for a line that does
/// not fit its tag, numbers that are not finite, a vertex that appears twice, an edge from a vertex to itself or to a
/// missing one (a file without any vertex is valid: it has only edges), elements of the plane and of space in one file,
/// and a file without edges. When all lines have been read, it also throws for edges whose information is not positive
/// definite, with their number. Rotations are normalized.
G2oFile readG2o(const std::filesystem::path& file, const G2oOptions& options = {});
G2oFile readG2o(LineReader lines, const G2oOptions& options = {});

/// Equal graphs give equal bytes. Numbers read back to the same bits. Quaternions are written with w >= 0 and read back
/// the same within rounding. A graph with edges only is written without vertices.
std::string toG2o(const G2oGraph2D& graph);
std::string toG2o(const G2oGraph3D& graph);

}  // namespace swiftlet::interfaces
