// What travels between the SLAM and the thread that runs its heavy work; private to slam2d.
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
  std::vector<FoundLoop> rejected;  ///< Closures that the graph refused before.
  /// An edge connected two passes: the graph is optimized, whether or not a loop is found.
  bool optimize_graph = false;
  /// No more scans come: the graph is optimized as a whole.
  bool is_last = false;
  Slam2dConfig config;
};

struct SlamResult::Data {
  std::uint64_t id = 0;
  std::vector<common::Pose2> T_map_key;  ///< Of every key scan of the task; empty when nothing was found.
  std::vector<SlamEdge> closures;
  std::vector<FoundLoop> rejected;  ///< Closures refused, now and before.
  std::vector<int> rejected_edges;  ///< Edges of the task's graph, ascending.
  std::optional<SlicedMap> map;     ///< Drawn anew, when the poses moved by enough to be seen.
};

}  // namespace swiftlet::perception
