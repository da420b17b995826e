// The heavy work of graph SLAM as a value: loop search, optimization, drawing the grid anew.
#pragma once

#include <memory>
#include <vector>

#include "perception/slam2d/slam_edge.hpp"

namespace swiftlet::perception {

/// Work to be run elsewhere. Holds only shared immutable data; cheap to copy.
struct SlamTask {
  struct Data;
  std::shared_ptr<const Data> data;
};

struct SlamResult {
  struct Data;
  std::shared_ptr<const Data> data;
  std::vector<LoopClosure> accepted;  ///< Loops closed, for the record.
};

/// Pure function of the task; safe on any thread.
SlamResult run(const SlamTask& task);

}  // namespace swiftlet::perception
