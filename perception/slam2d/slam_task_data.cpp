#include "perception/slam2d/slam_task_data.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/check.hpp"
#include "perception/slam2d/loop_consensus.hpp"
#include "perception/slam2d/map_repair.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A shift by less than this fraction of a cell is not visible in the grid.
constexpr double kVisibleCells = 0.25;
/// Greatest number of rejected closures that are kept; the oldest are dropped.
constexpr std::size_t kRejectedKept = 24;

/// A map is worth a repair from this violation on; a repair is one that takes away this share of it.
constexpr double kLeastViolation = 0.02, kRepairedShare = 0.5;

double greatestShift(const SlamGraph& graph, const std::vector<Pose2>& poses) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 step = between(graph.keys[i].T_map_body, poses[i]);
    // A rotation moves points some metres away.
    greatest = std::max(greatest, step.position_m().norm() + 3.0 * std::abs(step.yaw_rad));
  }
  return greatest;
}

/// The closures that the map misses where it contradicts itself, if they make it agree.
std::optional<LoopConsensus> repaired(const SlamTask::Data& in) {
  std::vector<Pose2> poses;
  for (const KeyScan& key : in.graph.keys) poses.push_back(key.T_map_body);
  const MapJudgement before = judgeMap(in.graph, poses);
  if (before.violation() < kLeastViolation) return std::nullopt;
  const std::vector<FoundLoop> loops = loopsWhereContradicting(in.graph, before, in.config);
  if (loops.empty()) return std::nullopt;
  LoopConsensus consensus = optimizeWithRejection(in.graph, loops, in.config);
  if (!consensus.refused.empty())
    if (auto overruled = consensusOfRejected(in.graph, loops, in.config)) consensus = std::move(*overruled);
  const double after = judgeMap(in.graph, consensus.T_map_key).violation();
  if (after > kRepairedShare * before.violation()) return std::nullopt;
  return consensus;
}

}  // namespace

SlamResult run(const SlamTask& task) {
  SWIFTLET_CHECK(task.data != nullptr);
  const SlamTask::Data& in = *task.data;
  auto out = std::make_shared<SlamResult::Data>();
  out->id = in.id;
  SlamResult result;
  const auto keep = [&](LoopConsensus& consensus) {
    out->rejected_edges = std::move(consensus.rejected_edges);
    for (const FoundLoop& loop : consensus.accepted) {
      out->closures.push_back(loop.edge);
      result.accepted.push_back({loop.edge.from, loop.edge.to, loop.edge.T_from_to, loop.quality, loop.shift_m});
    }
  };
  std::vector<FoundLoop> loops;
  for (const LoopCandidate& candidate : in.candidates)
    if (const auto found = searchLoop(in.graph, in.query, candidate, in.config)) loops.push_back(*found);
  out->rejected = in.rejected;
  if (!loops.empty() || in.optimize_graph || in.is_last) {
    LoopConsensus consensus = optimizeWithRejection(in.graph, loops, in.config);
    if (!consensus.refused.empty()) {
      out->rejected.insert(out->rejected.end(), consensus.refused.begin(), consensus.refused.end());
      if (auto overruled = consensusOfRejected(in.graph, out->rejected, in.config)) {
        consensus = std::move(*overruled);
        out->rejected.clear();
      } else if (out->rejected.size() > kRejectedKept) {
        out->rejected.erase(out->rejected.begin(), out->rejected.end() - static_cast<std::ptrdiff_t>(kRejectedKept));
      }
    }
    // Without a reason to change them, the poses are kept: each change makes the map jump.
    if (in.is_last || in.optimize_graph || !consensus.accepted.empty() || !consensus.rejected_edges.empty())
      out->T_map_key = std::move(consensus.T_map_key);
    keep(consensus);
  }
  if (in.is_repair)
    if (auto consensus = repaired(in)) {
      out->T_map_key = std::move(consensus->T_map_key);
      keep(*consensus);
    }
  if (in.config.live_map && !out->T_map_key.empty() &&
      greatestShift(in.graph, out->T_map_key) > kVisibleCells * in.config.grid.resolution_m) {
    SlamGraph moved = in.graph;
    for (std::size_t i = 0; i < moved.keys.size(); ++i) moved.keys[i].T_map_body = out->T_map_key[i];
    // A write to the map clones its tiles first.
    out->map = drawMap(moved, in.config.grid).snapshot();
  }
  result.data = std::move(out);
  return result;
}

}  // namespace swiftlet::perception
