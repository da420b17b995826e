// What `swiftlet explore-bench` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "evaluation/exploration/flat_flight.hpp"

namespace swiftlet::apps {

struct BenchFlight {
  std::string explorer;
  evaluation::FlatFlight flight;
};

struct BenchResult {
  std::string world;
  std::optional<Eigen::Vector2d> start_m;  ///< nullopt of a flight: where its scenario says.
  double bound_m = 0.0;  ///< Length of the shortest tour found with the whole map known; 0: not asked for.
  std::vector<BenchFlight> flights;
};

/// A row a flight; and of how much faster each explorer is than the first one, the geometric mean over the worlds that
/// both complete, and the least.
std::string benchText(const std::vector<BenchResult>& results);
std::string benchJson(const std::vector<BenchResult>& results);

}  // namespace swiftlet::apps
