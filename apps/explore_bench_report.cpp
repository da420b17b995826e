#include "apps/explore_bench_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace swiftlet::apps {
namespace {

/// How many times faster the second explorer is than the first.
struct Gain {
  int worlds = 0;
  int slower = 0;
  double exploring = 0.0, with_home = 0.0;  ///< Geometric means.
  double least = 0.0;                       ///< Of exploring.
  std::string least_in;
};

Gain gainOf(const std::vector<BenchResult>& results, std::size_t first, std::size_t second) {
  Gain gain;
  double log_exploring = 0.0, log_with_home = 0.0;
  for (const BenchResult& result : results) {
    const evaluation::FlatFlight &a = result.flights[first].flight, &b = result.flights[second].flight;
    if (!a.complete || !b.complete || !(b.explore_s > 0.0)) continue;
    const double ratio = a.explore_s / b.explore_s;
    log_exploring += std::log(ratio);
    log_with_home += std::log(a.total_s / b.total_s);
    if (ratio < 1.0) ++gain.slower;
    if (gain.worlds++ > 0 && ratio >= gain.least) continue;
    gain.least = ratio;
    gain.least_in = result.world;
  }
  if (gain.worlds > 0) {
    gain.exploring = std::exp(log_exploring / gain.worlds);
    gain.with_home = std::exp(log_with_home / gain.worlds);
  }
  return gain;
}

/// What a flight of the simulated vehicle does not tell is 0.
std::string ifTold(double value) { return value > 0.0 ? fmt::format("{:.0f}", value) : "-"; }

std::string shareOfBound(const evaluation::FlatFlight& flight, double bound_m) {
  return bound_m > 0.0 ? fmt::format("{:.2f}", flight.total_m / bound_m) : "-";
}

}  // namespace

std::string benchText(const std::vector<BenchResult>& results) {
  std::string text;
  for (const BenchResult& result : results) {
    text += result.world;
    if (result.start_m) text += fmt::format(" from \"{:.2f};{:.2f}\"", result.start_m->x(), result.start_m->y());
    text += result.bound_m > 0.0 ? fmt::format(", bound {:.1f} m\n", result.bound_m) : "\n";
    text +=
        "  explorer           explore s   path m    home s   path m  of bound  calls  viewpoints  longest call ms\n";
    for (const BenchFlight& entry : result.flights) {
      const evaluation::FlatFlight& f = entry.flight;
      text +=
          fmt::format("  {:<18} {:>9.1f} {:>8.1f} {:>9.1f} {:>8.1f} {:>9} {:>6} {:>11} {:>16}{}\n", entry.explorer,
                      f.explore_s, f.explore_m, f.total_s, f.total_m, shareOfBound(f, result.bound_m), ifTold(f.calls),
                      ifTold(f.viewpoints), ifTold(1e3 * f.longest_call_s), f.complete ? "" : "  FAILED: " + f.failure);
    }
  }
  if (results.empty()) return text;
  const std::size_t explorers = results.front().flights.size();
  for (std::size_t a = 0; a < explorers; ++a)
    for (std::size_t b = a + 1; b < explorers; ++b) {
      const Gain gain = gainOf(results, a, b);
      if (gain.worlds == 0) continue;
      text += fmt::format(
          "{} against {}: {:.2f}x faster, {:.2f}x with the flight home (geometric means of {}); least "
          "{:.2f}x in {}, slower in {}\n",
          results.front().flights[b].explorer, results.front().flights[a].explorer, gain.exploring, gain.with_home,
          gain.worlds, gain.least, gain.least_in, gain.slower);
    }
  return text;
}

std::string benchJson(const std::vector<BenchResult>& results) {
  nlohmann::json json = nlohmann::json::array();
  for (const BenchResult& result : results) {
    nlohmann::json world{{"world", result.world}, {"bound_m", result.bound_m}, {"flights", nlohmann::json::array()}};
    if (result.start_m) world["start"] = {result.start_m->x(), result.start_m->y()};
    for (const BenchFlight& entry : result.flights) {
      const evaluation::FlatFlight& f = entry.flight;
      world["flights"].push_back({{"explorer", entry.explorer},
                                  {"complete", f.complete},
                                  {"failure", f.failure},
                                  {"explore_s", f.explore_s},
                                  {"explore_m", f.explore_m},
                                  {"total_s", f.total_s},
                                  {"total_m", f.total_m},
                                  {"unseen_share", f.unseen_share},
                                  {"calls", f.calls},
                                  {"viewpoints", f.viewpoints},
                                  {"longest_call_s", f.longest_call_s}});
    }
    json.push_back(std::move(world));
  }
  return json.dump(2) + "\n";
}

}  // namespace swiftlet::apps
