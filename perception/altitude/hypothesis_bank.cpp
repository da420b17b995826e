#include "perception/altitude/hypothesis_bank.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"
#include "perception/altitude/ground_slopes.hpp"

namespace swiftlet::perception::altitude {

using common::square;
using common::Time;

namespace {

// How often something begins, by the path or by the time: orders of magnitude of furnished rooms, which were chosen on
// the flights of tests/altitude (docs/decisions/altitude.md#112, where two of them were varied).
constexpr double kEdges_1_m = 0.5;            ///< Edges of furniture, in a room that has some;
constexpr double kClutter_m = 0.5;            ///< where one was, there are others within this distance.
constexpr double kSomethingMoves_1_s = 0.02;  ///< Something is put below or taken away while the vehicle stays.
constexpr double kSlopes_1_m = 0.05, kSteepSlopes_1_m = 0.02, kSlopeEnds_1_m = 1.0;
constexpr double kAsSeen = 10.0;  ///< A slope begins or ends so much oftener where a camera saw it do so, and seldomer.
constexpr double kRestless_1_s = 0.002, kCalm_1_s = 2.0;  ///< The bias changes fast, and stops doing so.
constexpr double kLost_1_s = 2e-5;                        ///< Something that none of these hypotheses explains.

// What it is like.
constexpr double kGradientSigma = 0.25;      ///< Ramps have up to 15 degrees, the backs of sofas 20;
constexpr double kSteepGradientSigma = 1.5;  ///< cushions, banisters and heaps are steeper.
constexpr double kLost_m = 1.0, kLost_m_s = 1.0, kLost_m_s2 = 0.3;

// What a surface that comes into sight is: a level known at the place or near it, the floor, another surface.
constexpr double kKnownHere = 0.8, kKnownNear = 0.15, kFloorAnywhere = 0.5, kOther = 0.5, kOtherHere = 0.1;
constexpr double kReturn = 0.005;  ///< The share of edges behind which lies what was below a moment ago.
/// Most furniture is lower than a metre. Hardly anything lies just below the take-off floor, and little deep below it.
constexpr double kFurniture_m = 1.0, kLow_1_m = 0.8, kHigh_1_m = 0.1;
constexpr double kOnFloor_m = 0.03, kLeastStepDown_m = 0.25, kSunk = 1e-3, kBelowFloor = 0.02;

constexpr double kGate2 = 25.0;  ///< What is farther off than five standard deviations is another surface.
/// Without anything below for this long, the other sensors know the height better than this filter remembers it.
constexpr double kRemembered_s = 0.5;

// How many hypotheses there are.
constexpr std::size_t kMost = 30;
constexpr int kBranching = 3;                    ///< Slopes begin in so many of the likeliest.
constexpr double kNegligible = -14.0;            ///< Logarithm of a weight, against the best, that is given up.
constexpr double kEnds_m = 0.05, kLost_s = 0.2;  ///< How often it is asked whether a slope has ended, or all is lost.
constexpr double kSure = 0.9, kAgree_m = 0.02;

double weightOf(const GroundHypothesis& h) { return std::exp(h.log_weight); }

/// Whether both say the same of what is below now, and of the vehicle: within what no flight would notice.
bool areSame(const GroundHypothesis& a, const GroundHypothesis& b, Time now) {
  if (a.restless != b.restless) return false;
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = a.surfaces[static_cast<std::size_t>(i)];
    if (!s.isSeen(now)) continue;
    const auto match = std::find_if(b.surfaces.begin(), b.surfaces.end(), [&](const Surface& t) {
      return t.isSeen(now) && t.sight == s.sight && t.level == s.level && t.slopes == s.slopes;
    });
    if (match == b.surfaces.end()) return false;
    if (std::abs(a.height_m(i) - b.height_m(static_cast<int>(match - b.surfaces.begin()))) > 0.01) return false;
  }
  const auto alike = [](double one, double other, double factor) {
    return one <= factor * other && other <= factor * one;
  };
  const VerticalState x = a.vertical(), y = b.vertical();
  return std::abs(x.height_m - y.height_m) < 0.005 && std::abs(x.velocity_m_s - y.velocity_m_s) < 0.01 &&
         std::abs(x.bias_m_s2 - y.bias_m_s2) < 0.02 && alike(x.covariance(2, 2), y.covariance(2, 2), 2.0) &&
         (a.gradient() - b.gradient()).norm() < 0.02 && alike(a.gradientVariance(), b.gradientVariance(), 4.0);
}

}  // namespace

double HypothesisBank::variance_m2(int beams) const {
  return square(config_.beam_noise_m) / beams + square(kFlatness_m);
}

void HypothesisBank::start(const VerticalState& state, Time now) {
  bank_.assign(1, GroundHypothesis(state, now, ++serials_));
  seen_ = now;
}

void HypothesisBank::predict(const ScanStep& step, const std::optional<InertialClimb>& climb,
                             const VerticalState& known, bool at_rest,
                             const std::optional<Eigen::Vector2d>& gradient_map) {
  step_ = step;
  gradient_ = gradient_map;
  if (!climb || (step.now - seen_).seconds() > kRemembered_s) {
    bank_.erase(bank_.begin() + 1, bank_.end());
    bank_.front().assume(known);
    return;
  }
  for (GroundHypothesis& h : bank_) {
    for (int i = 0; i < kSurfaces; ++i)
      if ((step.before - h.surfaces[static_cast<std::size_t>(i)].last).seconds() > kRemembered_s) h.leave(i);
    h.predict(step.seconds(), *climb, at_rest);
    h.edges_1_m *= std::exp(-step.moved_m() / kClutter_m);
  }
  branch();
}

/// What has begun or ended, but for what begins with the surfaces of the next scan.
void HypothesisBank::branch() {
  next_.clear();
  const auto add = [&](const GroundHypothesis& from, double chance) -> GroundHypothesis& {
    next_.push_back(from);
    next_.back().log_weight += std::log(chance);
    return next_.back();
  };
  if (unbranched_m_ += step_.moved_m(); unbranched_m_ >= kEnds_m) {
    const bool seen_level = gradient_ && gradient_->isZero();
    for (const GroundHypothesis& h : bank_)
      if (h.slopingSurface() >= 0)
        add(h, (seen_level ? kAsSeen : 1.0) * kSlopeEnds_1_m * unbranched_m_).endSlope(step_.to_map_m);
    unbranched_m_ = 0.0;
  }
  for (const bool restless : {false, true}) {
    const auto likeliest =
        std::find_if(bank_.begin(), bank_.end(), [&](const auto& h) { return h.restless == restless; });
    if (likeliest != bank_.end())
      add(*likeliest, (restless ? kCalm_1_s : kRestless_1_s) * step_.seconds()).restless = !restless;
  }
  if (unbranched_s_ += step_.seconds(); unbranched_s_ >= kLost_s) {
    add(bank_.front(), kLost_1_s * unbranched_s_).doubt(square(kLost_m), square(kLost_m_s), square(kLost_m_s2));
    unbranched_s_ = 0.0;
  }
  bank_.insert(bank_.end(), next_.begin(), next_.end());
}

void HypothesisBank::weigh(std::span<const SurfaceSight> sights) {
  if (sights.empty()) {
    near_.clear();
    return prune();
  }
  seen_ = step_.now;
  const std::size_t most = std::min<std::size_t>(sights.size(), kSurfaces);
  // The largest surface comes last, as recognize() is about it.
  for (std::size_t number = most; number-- > 0;) {
    look(sights[number]);
    next_.clear();
    int rank = 0;
    for (const GroundHypothesis& h : bank_) associate(h, rank++ < kBranching, sights[number], static_cast<int>(number));
    std::swap(bank_, next_);
    prune();
  }
  recognize();
  prune();
}

void HypothesisBank::look(const SurfaceSight& sight) {
  center_ = levels_.cellAt(sight.center_map_m);
  levels_.near(center_, kNeighbourhood_m, near_);
  if (config_.one_floor && (near_.empty() || near_.front() != kFloor)) near_.insert(near_.begin(), kFloor);
  known_here_ = std::any_of(near_.begin(), near_.end(), [&](int id) { return levels_.coversAround(id, center_); });
}

/// A small surface is part of a level only if that is known at its place. The floor may be anywhere.
bool HypothesisBank::mayBe(int level, bool small) const {
  return !small || levels_.isSame(level, kFloor) || levels_.coversAround(level, center_);
}

double HypothesisBank::shareOfLevel(int level) const {
  if (levels_.coversAround(level, center_)) return kKnownHere;
  return levels_.isSame(level, kFloor) ? kFloorAnywhere : kKnownNear;
}

/// Density of the height of a surface that is no known level.
double HypothesisBank::shareOfUnknown_1_m(double height_m) const {
  double density_1_m = height_m < kFurniture_m ? kLow_1_m : kHigh_1_m;
  if (config_.one_floor && height_m < kOnFloor_m) density_1_m *= height_m > -kLeastStepDown_m ? kSunk : kBelowFloor;
  return (known_here_ ? kOtherHere : kOther) * density_1_m;
}

/// All that the hypothesis allows this surface to be, into next_.
void HypothesisBank::associate(const GroundHypothesis& h, bool branches, const SurfaceSight& sight, int number) {
  const double distance_m = sight.distance_below_m, noise_m2 = variance_m2(sight.beams);
  const double edge =
      std::min(0.5, (kEdges_1_m + h.edges_1_m) * step_.moved_m() + kSomethingMoves_1_s * step_.seconds());
  const bool any_before =
      std::any_of(h.surfaces.begin(), h.surfaces.end(), [&](const Surface& s) { return s.isSeen(step_.before); });
  const auto goOn = [&](GroundHypothesis from, int i, double share) {
    const auto innovation = from.innovation(i, sight.center_map_m, distance_m, noise_m2);
    if (innovation.squaredMahalanobis() > kGate2) return;
    from.log_weight += std::log(share) + innovation.logDensity();
    from.measure(i, sight.center_map_m, distance_m, noise_m2);
    from.surfaces[static_cast<std::size_t>(i)].seenAgain(step_.now, number);
    next_.push_back(from);
  };
  const auto slope = [&](int i, const Eigen::Vector2d& gradient, double sigma, double per_m) {
    GroundHypothesis sloping = h;
    sloping.beginSlope(i, step_.from_map_m, gradient, square(sigma));
    goOn(sloping, i, std::min(0.5, per_m * step_.moved_m()));
  };
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = h.surfaces[static_cast<std::size_t>(i)];
    if (s.serial == 0 || s.last == step_.now) continue;
    const bool goes_on = s.isSeen(step_.before);
    goOn(h, i, goes_on ? 1.0 - edge : kReturn * (any_before ? edge : 1.0));
    if (!goes_on || !branches || h.slopingSurface() >= 0 || step_.moved_m() <= 0.0) continue;
    if (gradient_ && !gradient_->isZero()) {
      slope(i, *gradient_, GroundSlopes::kGradientSigma, kAsSeen * kSlopeEnds_1_m);
      continue;
    }
    const double share = gradient_ ? 1.0 / kAsSeen : 1.0;
    slope(i, Eigen::Vector2d::Zero(), kGradientSigma, share * kSlopes_1_m);
    slope(i, Eigen::Vector2d::Zero(), kSteepGradientSigma, share * kSteepSlopes_1_m);
  }

  const double new_share = any_before ? edge : 1.0;
  GroundHypothesis another = h;
  if (any_before) another.edges_1_m += 1.0 / kClutter_m;
  const int i = another.makeRoom();
  Surface& surface = another.surfaces[static_cast<std::size_t>(i)];
  surface = {.serial = ++serials_, .first = step_.now};
  surface.seenAgain(step_.now, number);
  for (const int id : near_) {
    if (!mayBe(id, true)) continue;
    const bool below_already = std::any_of(h.surfaces.begin(), h.surfaces.end(), [&](const Surface& s) {
      return s.level != kNoLevel && levels_.isSame(s.level, id);
    });
    if (below_already) continue;
    const LevelEstimate& level = levels_.at(id);
    const auto innovation =
        h.innovationOver(level.height_m, distance_m, noise_m2 + level.variance_m2 + square(kFlatness_m));
    if (innovation.squaredMahalanobis() > kGate2) continue;
    next_.push_back(another);
    GroundHypothesis& over = next_.back();
    over.surfaces[static_cast<std::size_t>(i)].level = id;
    over.log_weight += std::log(new_share * shareOfLevel(id)) + innovation.logDensity();
    over.meetKnown(i, level.height_m, level.variance_m2);
    over.measure(i, sight.center_map_m, distance_m, noise_m2);
  }
  another.log_weight += std::log(new_share * shareOfUnknown_1_m(h.vertical().height_m - distance_m));
  another.meetUnknown(i, distance_m, noise_m2);
  next_.push_back(another);
}

/// The largest surface may turn out to be a known level, once its height is known better than when it came into sight.
void HypothesisBank::recognize() {
  next_.clear();
  for (GroundHypothesis& h : bank_)
    for (int i = 0; i < kSurfaces; ++i) {
      Surface& s = h.surfaces[static_cast<std::size_t>(i)];
      if (!s.isSeen(step_.now) || s.sight != 0 || s.level != kNoLevel || s.slopes) continue;
      for (const int id : near_) {
        if (s.denied_level == id || !mayBe(id, (step_.now - s.first).seconds() < kSmall_s)) continue;
        const LevelEstimate& level = levels_.at(id);
        const auto innovation = h.innovationOfHeight(i, level.height_m, level.variance_m2 + square(kFlatness_m));
        if (innovation.squaredMahalanobis() > kGate2) continue;
        next_.push_back(h);
        next_.back().log_weight += std::log(shareOfLevel(id)) + innovation.logDensity();
        next_.back().knowHeight(i, level.height_m, std::max(level.variance_m2, 1e-8));
        next_.back().surfaces[static_cast<std::size_t>(i)].level = id;
        h.log_weight += std::log(shareOfUnknown_1_m(h.height_m(i)));
        s.denied_level = id;
        break;
      }
    }
  bank_.insert(bank_.end(), next_.begin(), next_.end());
}

void HypothesisBank::prune() {
  std::stable_sort(bank_.begin(), bank_.end(),
                   [](const auto& a, const auto& b) { return a.log_weight > b.log_weight; });
  const double best = bank_.front().log_weight;
  next_.clear();
  for (GroundHypothesis& h : bank_) {
    h.log_weight -= best;
    if (h.log_weight < kNegligible) break;
    const auto same =
        std::find_if(next_.begin(), next_.end(), [&](const auto& kept) { return areSame(kept, h, step_.now); });
    if (same != next_.end())
      same->log_weight += std::log1p(std::exp(h.log_weight - same->log_weight));
    else if (next_.size() < kMost)
      next_.push_back(h);
  }
  std::swap(bank_, next_);
  double sum = 0.0;
  for (const GroundHypothesis& h : bank_) sum += weightOf(h);
  for (GroundHypothesis& h : bank_) h.log_weight -= std::log(sum);
}

bool HypothesisBank::isSure() const {
  double share = 0.0;
  for (const GroundHypothesis& h : bank_)
    if (std::abs(h.vertical().height_m - best().vertical().height_m) < kAgree_m) share += weightOf(h);
  return share >= kSure;
}

VerticalState HypothesisBank::state() const {
  VerticalState state = best().vertical();
  const Eigen::Vector3d mean = state.mean();
  for (const GroundHypothesis& h : bank_) {
    const Eigen::Vector3d off = h.vertical().mean() - mean;
    state.covariance += weightOf(h) * off * off.transpose();
  }
  return state;
}

void HypothesisBank::nameLevel(int serial, int level) {
  for (GroundHypothesis& h : bank_)
    for (Surface& s : h.surfaces)
      if (s.serial == serial && !s.slopes && s.level == kNoLevel) s.level = level;
}

}  // namespace swiftlet::perception::altitude
