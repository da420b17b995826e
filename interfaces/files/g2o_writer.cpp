#include <fmt/format.h>

#include "interfaces/files/g2o.hpp"

namespace swiftlet::interfaces {
namespace {

/// The shortest decimals that read back to the same bits. Never a negative zero, because then equal graphs would
/// differ.
void put(std::string& text, double value) { fmt::format_to(std::back_inserter(text), " {}", value + 0.0); }

void put(std::string& text, const common::Pose2& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.yaw_rad}) put(text, value);
}

void put(std::string& text, const common::Pose3& pose) {
  for (const double value : pose.position_m) put(text, value);
  const double sign = pose.rotation.w() < 0.0 ? -1.0 : 1.0;
  for (const double value : pose.rotation.coeffs()) put(text, sign * value);
}

template <typename Graph>
std::string written(const Graph& graph, const char* vertex_tag, const char* edge_tag) {
  std::string text;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    text += fmt::format("{} {}", vertex_tag, graph.ids[i]);
    put(text, graph.poses[i]);
    text += '\n';
  }
  for (const int index : graph.fixed) text += fmt::format("FIX {}\n", graph.ids[static_cast<std::size_t>(index)]);
  for (const auto& edge : graph.edges) {
    text += fmt::format("{} {} {}", edge_tag, graph.ids[static_cast<std::size_t>(edge.from)],
                        graph.ids[static_cast<std::size_t>(edge.to)]);
    put(text, edge.T_from_to);
    for (int row = 0; row < Graph::kErrors; ++row)
      for (int col = row; col < Graph::kErrors; ++col) put(text, edge.information(row, col));
    text += '\n';
  }
  return text;
}

}  // namespace

std::string toG2o(const G2oGraph2D& graph) { return written(graph, "VERTEX_SE2", "EDGE_SE2"); }
std::string toG2o(const G2oGraph3D& graph) { return written(graph, "VERTEX_SE3:QUAT", "EDGE_SE3:QUAT"); }

}  // namespace swiftlet::interfaces
