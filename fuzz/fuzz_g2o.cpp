// links: interfaces common
// Any bytes, also compressed ones, as a pose graph: refused as InputError, or a sound graph that is written and read
// back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "interfaces/files/g2o.hpp"

namespace {

using namespace swiftlet;

template <typename Graph>
void check(const Graph& graph) {
  const int size = static_cast<int>(graph.ids.size());
  if (graph.edges.empty() || (!graph.poses.empty() && graph.poses.size() != graph.ids.size())) std::abort();
  for (const auto& pose : graph.poses)
    if (!isFinite(pose)) std::abort();
  for (const auto& edge : graph.edges)
    if (edge.from < 0 || edge.from >= size || edge.to < 0 || edge.to >= size || edge.from == edge.to ||
        !isFinite(edge.T_from_to) || !edge.information.allFinite())
      std::abort();

  const std::string written = toG2o(graph);
  const auto again = interfaces::readG2o(interfaces::LineReader::fromBytes(written, "written"));
  const auto& back = std::get<Graph>(again.graph);
  if (back.ids != graph.ids || back.fixed != graph.fixed || back.edges.size() != graph.edges.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string_view bytes{reinterpret_cast<const char*>(data), size};
    const auto file = interfaces::readG2o(interfaces::LineReader::fromBytes(bytes, "fuzz.g2o", {1 << 16, 1 << 22}));
    std::visit([](const auto& graph) { check(graph); }, file.graph);
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
