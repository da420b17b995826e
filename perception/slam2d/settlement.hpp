// Which closures of a graph are believed: the new ones, and those it has. Pure functions; private to slam2d.
#pragma once

#include <optional>
#include <vector>

#include "perception/slam2d/loop_search.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

struct Settled {
  std::vector<common::Pose2> T_map_key;
  std::vector<FoundLoop> accepted, refused;
  std::vector<int> taken_back;  ///< Edges of the graph, ascending.
};

/// Optimizes, and takes back the closure that fits worst, new or old, until all that are left fit.
Settled settle(const SlamGraph& graph, const std::vector<FoundLoop>& loops, const Slam2dConfig& config);

/// Closures that the graph refuses one by one may be right, and the graph wrong: it closed a loop in the wrong place of
/// a corridor, and what it matched there held it. Takes the doubted ones for certain, and everything else that ties one
/// pass to another for doubtful. They are believed if more of them agree than they contradict.
std::optional<Settled> turnedOver(const SlamGraph& graph, const std::vector<FoundLoop>& doubted,
                                  const Slam2dConfig& config);

}  // namespace swiftlet::perception
