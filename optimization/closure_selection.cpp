#include "optimization/closure_selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimization/edge_innovation.hpp"
#include "optimization/variance_factor.hpp"

namespace swiftlet::optimization {
namespace {

/// From one step to the next the truncation of the least squares becomes narrower by this factor, until fewer closures
/// than this share of them are below it.
constexpr double kNarrowing = 2.0, kLeastAgreement = 0.2;
constexpr double kLeastTruncation = 1e-12;  ///< Of a squared innovation: closures that agree but for rounding.
/// What refusing a closure costs: refusing one of n must lower the logarithm of the variance factor by 5 / n.
constexpr double kRefusalCost = 5.0;
/// Right closures of the usual data sets are off by up to 18 standard deviations.
constexpr double kContradictionSigmas = 25.0;
constexpr double kSameFactor = 4.0;       ///< Closures that agree only if their variances are greater do not agree.
constexpr double kGreatestFactor = 9.0;   ///< Closures that are three times as far off as their information says.
constexpr std::size_t kFewClosures = 40;  ///< Of fewer closures, at most one is beyond 95 %.
constexpr int kRounds = 40;
constexpr int kIterations = 30;

class Selector {
 public:
  Selector(WeightedGraph& graph, std::vector<bool> candidates)
      : graph_(graph), candidates_(std::move(candidates)), kept_(candidates_.size()) {
    for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i] = !graph.closures()[i] || candidates_[i];
  }

  /// The best of what follows from three starts: the best and the narrowest of graduation, and odometry.
  ClosureSelection run() {
    optimizeKept();
    auto starts = graduated();
    starts.push_back(closestToOdometry());
    std::vector<bool> best;
    double least_cost = 0.0;
    for (const auto& start : starts) {
      keep(start);
      refine();
      if (!best.empty() && cost() >= least_cost) continue;
      best = kept_;
      least_cost = cost();
    }
    keep(best);
    return result();
  }

  /// Keeps all closures, and judges each by the others. False closures make the factor too great, so here
  /// standard deviations are at most those of the information.
  ClosureSelection look() {
    take(graph_.squaredInnovationsOfEach());
    return result(1.0);
  }

  /// Whether a kept closure is beyond what belongs to the others, even if their tail is heavy. A few have no
  /// tail.
  bool oneMayStandOut() const {
    return count(kept_) < kFewClosures || greatestKept() > gateOf(squaredOf(kept_), graph_.errorSize());
  }

  /// Optimizes once more, where others have moved the poses.
  void optimizeKept() {
    graph_.optimize(std::vector<double>(kept_.begin(), kept_.end()), kIterations);
    ++optimizations_;
    take(graph_.squaredInnovations(kept_));
  }

 private:
  /// Truncated least squares with a truncation that becomes narrower, from one beyond all closures: the best of what
  /// was kept on the way, and the last.
  std::vector<std::vector<bool>> graduated() {
    const double closures = static_cast<double>(count(candidates_));
    std::vector<bool> best = kept_;
    double least_cost = cost(), truncation = std::numeric_limits<double>::max();
    std::vector<bool> last = kept_;
    while (static_cast<double>(count(kept_)) > kLeastAgreement * closures) {
      last = kept_;
      truncation = std::min(truncation, greatestKept()) / kNarrowing;
      if (truncation < kLeastTruncation) break;
      keepWhere([&](std::size_t i) { return squared_[i] < truncation; });
      if (cost() >= least_cost) continue;
      least_cost = cost();
      best = kept_;
    }
    return {best, last};
  }

  /// The closures that agree best with odometry alone.
  std::vector<bool> closestToOdometry() {
    keepWhere([](std::size_t) { return false; });
    std::vector<double> squared = squaredOf(candidates_);
    if (squared.empty()) return kept_;
    const auto least =
        squared.begin() + static_cast<std::ptrdiff_t>(kLeastAgreement * static_cast<double>(squared.size()));
    std::nth_element(squared.begin(), least, squared.end());
    std::vector<bool> closest = kept_;
    for (std::size_t i = 0; i < closest.size(); ++i)
      if (candidates_[i]) closest[i] = alone_[i] <= *least;
    return closest;
  }

  /// Removes the worst closures; if none is left to remove, restores those that agree: at first only those that
  /// agree as well as most. Each comes back at most twice, so that it ends.
  void refine() {
    std::vector<int> returns(kept_.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      const double gate = gateOf(squaredOf(kept_), graph_.errorSize());
      if (!remove(gate) && !takeBack(gate / kTailRatio, returns) && !takeBack(gate, returns)) return;
      optimizeKept();
    }
  }

  bool remove(double gate) {
    const double worst = greatestKept();
    if (worst <= gate) return false;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (candidates_[i] && squared_[i] > std::max(gate, 0.5 * worst)) kept_[i] = false;
    return true;
  }

  bool takeBack(double gate, std::vector<int>& returns) {
    bool changed = false;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (kept_[i] || !candidates_[i] || squared_[i] >= gate || returns[i] >= 2) continue;
      kept_[i] = changed = true;
      ++returns[i];
    }
    return changed;
  }

  double cost() const {
    const double kept = static_cast<double>(count(kept_)), refused = static_cast<double>(count(candidates_)) - kept;
    return kept * std::log(factor()) + kRefusalCost * refused;
  }

  double factor() const { return varianceFactor(squaredOf(kept_), graph_.errorSize()); }

  template <typename Choice>
  void keepWhere(Choice&& choice) {
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (candidates_[i]) kept_[i] = choice(i);
    optimizeKept();
  }

  void keep(const std::vector<bool>& kept) {
    if (kept == kept_) return;
    kept_ = kept;
    optimizeKept();
  }

  void take(SquaredInnovations innovations) {
    alone_ = std::move(innovations.alone);
    squared_ = std::move(innovations.without_group);
    alone_.resize(kept_.size(), 0.0);
    squared_.resize(kept_.size(), 0.0);
    for (std::size_t i = 0; i < squared_.size(); ++i) squared_[i] = std::max(squared_[i], alone_[i]);
  }

  /// The squared innovations of those closures among the candidates for which `chosen` is true.
  std::vector<double> squaredOf(const std::vector<bool>& chosen) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < alone_.size(); ++i)
      if (candidates_[i] && chosen[i]) values.push_back(alone_[i]);
    return values;
  }

  double greatestKept() const {
    double greatest = 0.0;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (candidates_[i] && kept_[i]) greatest = std::max(greatest, squared_[i]);
    return greatest;
  }

  std::size_t count(const std::vector<bool>& chosen) const {
    std::size_t number = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) number += candidates_[i] && chosen[i];
    return number;
  }

  ClosureSelection result(double greatest_factor = std::numeric_limits<double>::max()) const {
    ClosureSelection selection;
    selection.kept = kept_;
    selection.variance_factor = factor();
    const double variance = graph_.errorSize() * std::min(selection.variance_factor, greatest_factor);
    selection.iterations = optimizations_;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      selection.sigmas.push_back(candidates_[i] ? std::sqrt(squared_[i] / variance) : 0.0);
    selection.closures = count(candidates_);
    selection.refused = selection.closures - count(kept_);
    return selection;
  }

  WeightedGraph& graph_;
  std::vector<bool> candidates_;  ///< Closures that may be kept.
  std::vector<bool> kept_;
  std::vector<double> alone_;    ///< The squared innovations against all others,
  std::vector<double> squared_;  ///< and the greater of these and those without the group.
  int optimizations_ = 0;
};

/// Whether the refused closures are too few, or agree too little with each other, to be the right ones.
bool isSure(WeightedGraph& graph, const ClosureSelection& selection) {
  const std::size_t kept = selection.closures - selection.refused;
  if (kept > 0 && selection.variance_factor > kGreatestFactor) return false;
  if (selection.refused == 0 || 2 * selection.refused < kept) return true;
  if (selection.refused >= kept) return false;
  std::vector<bool> refused(selection.kept.size());
  for (std::size_t i = 0; i < refused.size(); ++i) refused[i] = !selection.kept[i];
  const ClosureSelection rivals = Selector(graph, std::move(refused)).run();
  if (rivals.variance_factor > kSameFactor * selection.variance_factor) return true;
  return 2 * (rivals.closures - rivals.refused) < kept;
}

}  // namespace

ClosureSelection selectClosures(WeightedGraph& graph) {
  Selector selector(graph, graph.closures());
  ClosureSelection selection = selector.run();
  selection.sure = isSure(graph, selection);
  selector.optimizeKept();
  return selection;
}

ClosureSelection contradictedClosures(WeightedGraph& graph) {
  Selector selector(graph, graph.closures());
  ClosureSelection all = selector.look();
  std::vector<bool> kept;
  for (const double sigmas : all.sigmas) kept.push_back(sigmas <= kContradictionSigmas);
  const bool one_is_far_off = kept != all.kept;
  if (!one_is_far_off && (all.variance_factor <= 1.0 || !selector.oneMayStandOut())) return all;
  ClosureSelection selection = selectClosures(graph);
  if (selection.refused > 0 || !one_is_far_off) return selection;
  all.kept = std::move(kept);
  all.refused = static_cast<std::size_t>(std::count(all.kept.begin(), all.kept.end(), false));
  return all;
}

}  // namespace swiftlet::optimization
