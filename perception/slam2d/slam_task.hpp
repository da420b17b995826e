// The heavy work of graph SLAM as a value: loop search, optimization, redrawing the grid.
#pragma once

#include <memory>
#include <vector>

#include "perception/slam2d/slam_edge.hpp"

namespace swiftlet::perception {

/// Work that may run on any thread. Holds only shared immutable data, so it is cheap to copy.
struct SlamTask {
  struct Data;
  std::shared_ptr<const Data> data;
};

/// The result of a task.
struct SlamResult {
  struct Data;
  std::shared_ptr<const Data> data;
  std::vector<LoopClosure> accepted;  ///< Accepted loop closures, for the record.
};

/// Computes a task. A pure function; may run on any thread.
SlamResult run(const SlamTask& task);

}  // namespace swiftlet::perception
