// Data passed between SLAM and the thread that runs its heavy work; private to slam2d.
#pragma once

#include <optional>
#include <vector>

#include "perception/slam2d/loop_search.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"
#include "perception/slam2d/slam_task.hpp"

namespace swiftlet::perception {

struct SlamTask::Data {
  std::uint64_t id = 0;
  SlamGraph graph;  ///< A copy; its scans are shared and immutable.
  int query = 0;
  std::vector<LoopCandidate> candidates;
  std::vector<FoundLoop> rejected;  ///< Loop closures that were rejected before.
  /// Optimize the graph even if no loop closure is found: an edge has connected two passes.
  bool optimize_graph = false;
  /// Optimize the graph as a whole: no more scans come.
  bool is_last = false;
  /// Look for the closures that the map misses if it contradicts itself.
  bool is_repair = false;
  Slam2dConfig config;
};

struct SlamResult::Data {
  std::uint64_t id = 0;
  std::vector<common::Pose2> T_map_key;  ///< Of every key scan of the task; empty when no pose changed.
  std::vector<SlamEdge> closures;
  std::vector<FoundLoop> rejected;  ///< Loop closures rejected now and before; the newest.
  std::vector<int> rejected_edges;  ///< Indices of edges of the task's graph, ascending.
  std::optional<SlicedMap> map;     ///< The redrawn map, if the poses moved visibly.
};

}  // namespace swiftlet::perception
