#include "optimization/best_start.hpp"

#include <algorithm>
#include <utility>

#include "optimization/chordal_start.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

/// A start whose chi2 falls by more was not in the basin of its solution from the beginning.
constexpr double kSureDecrease = 4.0;
/// The robust kernel's widths (sigmas), one after the other, before the plain sum of squares.
constexpr double kWidths[] = {2.0, 5.0, 20.0};
/// A chi2 of edges that agree but for rounding: a millionth of a sigma.
constexpr double kRounding = 1e-12;
/// Large enough for a first step of Gauss-Newton: the starts are near.
constexpr double kGaussNewtonRadius = 1e16;

template <typename Graph>
class Search {
 public:
  using Poses = decltype(Graph::poses);
  using Solution = BestStartSolution<typename Poses::value_type>;

  Search(Graph graph, const BestStartConfig& config) : graph_(std::move(graph)), config_(config), guess_(graph_.poses) {
    fix(graph_, anchorsOf(graph_));
    setRobust(false);
  }

  Solution run() {
    best_.poses = guess_;
    best_.chi2_guess = best_.chi2 = chi2At(guess_);
    best_.start = Start::kGuess;
    const Poses chordal = chordalStart(graph_);
    const double chi2_chordal = chi2At(chordal);
    attempt(Start::kChordal, chordal);
    const bool sure = best_.start == Start::kChordal && best_.converged && best_.chi2 * kSureDecrease > chi2_chordal &&
                      chi2_chordal <= best_.chi2_guess;
    if (sure) return best_;
    attempt(Start::kGuess, guess_);
    attempt(Start::kRobustChordal, robust(chordal));
    attempt(Start::kRobustGuess, robust(guess_));
    return best_;
  }

 private:
  double chi2At(const Poses& poses) const { return chi2Of(squaredErrors(graph_, poses)); }

  void setRobust(bool robust) {
    for (auto& edge : graph_.edges) edge.robust = robust;
  }

  void attempt(Start start, Poses poses) {
    graph_.poses = std::move(poses);
    PoseGraphConfig config;
    config.max_iterations = config_.max_iterations;
    config.relative_decrease = config_.relative_decrease;
    config.trust_radius = kGaussNewtonRadius;
    auto solution = optimize(graph_, config);
    const double chi2 = chi2Of(solution.squared_errors);
    ++best_.starts;
    best_.iterations += solution.iterations;
    const bool better = best_.starts == 1 ? chi2 <= best_.chi2 : chi2 < best_.chi2;
    if (better) {
      best_.poses = std::move(solution.poses);
      best_.chi2 = chi2;
      best_.start = start;
      best_.converged = solution.converged;
    } else if (solution.converged && chi2 <= best_.chi2 * (1.0 + config_.relative_decrease) + kRounding) {
      best_.converged = true;  // It came back to the best poses, but for rounding.
    }
  }

  /// Rough optimizations with robust kernels that widen: edges that are far off pull little at first, and then more.
  Poses robust(Poses poses) {
    graph_.poses = std::move(poses);
    setRobust(true);
    PoseGraphConfig config;
    config.max_iterations = std::min(config_.max_iterations, 30);
    config.relative_decrease = 1e-4;
    for (const double width : kWidths) {
      config.robust_width = width;
      auto solution = optimize(graph_, config);
      best_.iterations += solution.iterations;
      graph_.poses = std::move(solution.poses);
    }
    setRobust(false);
    return graph_.poses;
  }

  Graph graph_;
  BestStartConfig config_;
  Poses guess_;
  Solution best_;
};

}  // namespace

const char* toString(Start start) {
  switch (start) {
    case Start::kGuess:
      return "guess";
    case Start::kChordal:
      return "chordal";
    case Start::kRobustChordal:
      return "robust chordal";
    case Start::kRobustGuess:
      return "robust guess";
  }
  return "";
}

BestStartSolution<common::Pose2> optimizeFromBestStart(PoseGraph2D graph, const BestStartConfig& config) {
  return Search(std::move(graph), config).run();
}
BestStartSolution<common::Pose3> optimizeFromBestStart(PoseGraph3D graph, const BestStartConfig& config) {
  return Search(std::move(graph), config).run();
}

}  // namespace swiftlet::optimization
