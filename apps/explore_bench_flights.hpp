// The flights of `swiftlet explore-bench --fly`: the simulated vehicle instead of an ideal one.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/explore_bench_report.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::apps {

struct BenchFlightOptions {
  std::string system = "swiftlet";
  int seed = 1;
  int repeat = 1;   ///< Flights of each explorer in each world, with this seed and the next ones.
  std::string out;  ///< Of the runs; empty: a new folder, runs/TIME-explore-bench.
};

/// Explores a world (.sdf, .world), or the scenario of a trial (.yaml), comes home and lands, with each of the
/// explorers, from the same seeds: a result a seed. Prints the certificate of each flight unless it is `quiet`. Throws
/// InputError for a file that is neither.
std::vector<BenchResult> flyExplorers(const std::string& file,
                                      const std::vector<std::pair<std::string, planning::ExplorerKind>>& explorers,
                                      const BenchFlightOptions& options, bool quiet);

}  // namespace swiftlet::apps
