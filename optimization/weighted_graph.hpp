// A pose graph whose edges are weighted again and again, as seen by the algorithms that select edges: numbers of
// edges, whatever the graph's dimension.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace swiftlet::optimization {

struct PoseGraph2D;
struct PoseGraph3D;
struct SquaredInnovations;

class WeightedGraph {
 public:
  virtual ~WeightedGraph() = default;

  /// Degrees of freedom of an edge's error: 3 or 6.
  virtual int errorSize() const = 0;
  /// Of each edge whether it is a loop closure: it does not connect consecutive poses, or is not the first that does.
  virtual const std::vector<bool>& closures() const = 0;
  /// Moves the poses to the optimum for these weights of the edges, from where they are or, where that is better, from
  /// the chordal start.
  virtual void optimize(const std::vector<double>& weights, int max_iterations) = 0;
  /// Of each closure, at the present poses, which are the optimum for the edges that are kept: see EdgeInnovations.
  virtual SquaredInnovations squaredInnovations(const std::vector<bool>& kept) = 0;
  /// The same where all edges are kept and each closure is a group of its own; much faster in space.
  virtual SquaredInnovations squaredInnovationsOfEach() const = 0;
};

/// `places` are those of the poses along the trajectory. The graph must outlive it. Its poses are changed.
std::unique_ptr<WeightedGraph> weighted(PoseGraph2D& graph, const std::vector<int>& places);
std::unique_ptr<WeightedGraph> weighted(PoseGraph3D& graph, const std::vector<int>& places);

/// Loop closures that may repeat one mistake, in groups, each by its number; `ends` are the places of its poses along
/// the trajectory. Both ends of a closure are within 10 poses of those of another one of its group. A group of more
/// than `largest` is divided.
std::vector<std::vector<std::size_t>> closureGroups(const std::vector<std::pair<int, int>>& ends, std::size_t largest);

}  // namespace swiftlet::optimization
