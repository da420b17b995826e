// What swiftlet optimize says about a graph, as text and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "interfaces/files/g2o.hpp"

namespace swiftlet::apps {

/// What became of a graph.
enum class GraphVerdict {
  kConverged,
  kNotConverged,
  kContradictory,  ///< It converged, but some closures are far beyond their uncertainty: chi2 is impossible.
  kCannotTell,     ///< Too many closures were refused: they may be the right ones.
};
const char* toString(GraphVerdict verdict);

/// A closure that the others contradict, with the ids of the file.
struct ContradictedEdge {
  std::int64_t from = 0;
  std::int64_t to = 0;
  double sigmas = 0.0;  ///< Its innovation against the other edges, in estimated standard deviations.
};

/// The report about an optimized graph.
struct OptimizeReport {
  std::string graph;
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t closures = 0;
  std::size_t loose_parts = 0;  ///< Number of parts that no edges connect to a fixed vertex.
  int dimension = 0;
  std::int64_t degrees_of_freedom = 0;  ///< Of chi2_final, that of the edges that are kept.
  double chi2_initial = 0.0;
  double chi2_final = 0.0;
  double variance_factor = 1.0;  ///< See optimization::ClosureSelection.
  std::string start;
  int iterations = 0;  ///< Iterations of all starts together.
  double seconds = 0.0;
  GraphVerdict verdict = GraphVerdict::kConverged;
  bool robust = false;
  std::vector<ContradictedEdge> contradicted;  ///< Worst first; with `robust` they are refused.
  std::string written;
};

std::string jsonOf(const OptimizeReport& report, const interfaces::G2oFile& file);
std::string textOf(const OptimizeReport& report);

}  // namespace swiftlet::apps
