#include "perception/slam2d/slam_task_data.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "perception/slam2d/settlement.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A shift of less than this share of a cell does not show in the grid.
constexpr double kVisibleCells = 0.25;
/// So many closures that were refused are kept, the newest.
constexpr std::size_t kDoubted = 24;

double greatestShift(const SlamGraph& graph, const std::vector<Pose2>& poses) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 step = between(graph.keys[i].T_map_body, poses[i]);
    // A rotation moves what is seen some metres away.
    greatest = std::max(greatest, step.position_m().norm() + 3.0 * std::abs(step.yaw_rad));
  }
  return greatest;
}

}  // namespace

SlamResult run(const SlamTask& task) {
  SWIFTLET_CHECK(task.data != nullptr);
  const SlamTask::Data& in = *task.data;
  auto out = std::make_shared<SlamResult::Data>();
  out->id = in.id;
  SlamResult result;
  std::vector<FoundLoop> loops;
  for (const LoopCandidate& candidate : in.candidates)
    if (const auto found = searchLoop(in.graph, in.query, candidate, in.config)) loops.push_back(*found);
  out->doubted = in.doubted;
  if (!loops.empty() || in.settle || in.is_last) {
    Settled settled = settle(in.graph, loops, in.config);
    if (!settled.refused.empty()) {
      out->doubted.insert(out->doubted.end(), settled.refused.begin(), settled.refused.end());
      if (auto over = turnedOver(in.graph, out->doubted, in.config)) {
        settled = std::move(*over);
        out->doubted.clear();
      } else if (out->doubted.size() > kDoubted) {
        out->doubted.erase(out->doubted.begin(), out->doubted.end() - static_cast<std::ptrdiff_t>(kDoubted));
      }
    }
    // What changes nothing is not worth a jump of the map.
    if (in.is_last || in.settle || !settled.accepted.empty() || !settled.taken_back.empty())
      out->T_map_key = std::move(settled.T_map_key);
    out->taken_back = std::move(settled.taken_back);
    for (const FoundLoop& loop : settled.accepted) {
      out->closures.push_back(loop.edge);
      result.accepted.push_back({loop.edge.from, loop.edge.to, loop.edge.T_from_to, loop.quality, loop.shift_m});
    }
  }
  if (in.config.live_map && !out->T_map_key.empty() &&
      greatestShift(in.graph, out->T_map_key) > kVisibleCells * in.config.grid.resolution_m) {
    SlamGraph moved = in.graph;
    for (std::size_t i = 0; i < moved.keys.size(); ++i) moved.keys[i].T_map_body = out->T_map_key[i];
    out->map = drawMap(moved, in.config.grid).snapshot();  // Its tiles are cloned before anybody writes.
  }
  result.data = std::move(out);
  return result;
}

}  // namespace swiftlet::perception
