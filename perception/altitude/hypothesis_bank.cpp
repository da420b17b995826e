#include "perception/altitude/hypothesis_bank.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"
#include "perception/altitude/ground_cell.hpp"
#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception::altitude {

using common::square;
using common::Time;

namespace {

// How often what is below changes: orders of magnitude of furnished rooms, which were chosen on the flights of
// tests/altitude (docs/decisions/altitude.md#112).
constexpr double kEdges_1_m = 0.5;    ///< Rate along the path at which surfaces and slopes end.
constexpr double kSlopes_1_m = 0.05;  ///< Rate along the path at which slopes begin.
constexpr double kSway_m = 0.001;     ///< The beams wander by this between two scans while the vehicle hovers.
constexpr double kRestless_1_s = 0.002, kCalm_1_s = 2.0;  ///< Rates at which the bias begins and ends to change fast.
/// Probability that an unknown surface lies below the take-off floor: holes are rare.
constexpr double kBelowFloor = 1e-3;

constexpr std::size_t kMost = 30;  ///< Number of hypotheses, bounded for speed.
/// Logarithm of the weight, against the best, below which a hypothesis is given up.
constexpr double kNegligible = -14.0;
/// Squared Mahalanobis distance at which a likelihood is that small.
constexpr double kGate2 = -2.0 * kNegligible;
/// Two estimates are alike if they, and their standard deviations, differ by less than this share of the latter.
constexpr double kAlike = 0.5;

double weightOf(const GroundHypothesis& h) { return std::exp(h.log_weight); }

/// Whether what follows from a hypothesis with that probability would not be given up at once.
bool isWorthIt(const GroundHypothesis& h, double chance) { return h.log_weight + std::log(chance) > kNegligible; }

struct Gaussian {
  double mean, variance;
};

bool areAlike(const Gaussian& a, const Gaussian& b) {
  const auto [less, more] = std::minmax(a.variance, b.variance);
  return square(a.mean - b.mean) <= square(kAlike) * less && square(kAlike) * more <= less;
}

/// Whether both say the same of what is below now, and of the vehicle.
bool areSame(const GroundHypothesis& a, const GroundHypothesis& b, Time now) {
  if (a.restless != b.restless) return false;
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = a.surfaces[static_cast<std::size_t>(i)];
    if (!s.isSeen(now)) continue;
    const auto match = std::find_if(b.surfaces.begin(), b.surfaces.end(), [&](const Surface& t) {
      return t.isSeen(now) && t.sight == s.sight && t.level == s.level && t.slopes == s.slopes;
    });
    if (match == b.surfaces.end()) return false;
    const int j = static_cast<int>(match - b.surfaces.begin());
    if (!areAlike({a.height_m(i), a.variance_m2(i)}, {b.height_m(j), b.variance_m2(j)})) return false;
  }
  const VerticalState x = a.vertical(), y = b.vertical();
  for (int i = 0; i < 3; ++i)
    if (!areAlike({x.mean()[i], x.covariance(i, i)}, {y.mean()[i], y.covariance(i, i)})) return false;
  for (int i = 0; i < 2; ++i)
    if (!areAlike({a.gradient()[i], a.gradientVariance()[i]}, {b.gradient()[i], b.gradientVariance()[i]})) return false;
  return true;
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
  const bool forgotten = !climb || (step.now - seen_).seconds() > kConfirmed_s;
  if (forgotten) bank_.erase(bank_.begin() + 1, bank_.end());
  for (GroundHypothesis& h : bank_)
    for (int i = 0; i < kSurfaces; ++i)
      if (forgotten || h.surfaces[static_cast<std::size_t>(i)].last != seen_) h.leave(i);
  if (forgotten) return bank_.front().assume(known);
  for (GroundHypothesis& h : bank_) h.predict(step.seconds(), *climb, at_rest);
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
  const bool seen_level = gradient_ && gradient_->isZero();
  const double ends = (seen_level ? 1.0 / kSlopeCell_m : kEdges_1_m) * step_.moved_m();
  for (const GroundHypothesis& h : bank_)
    if (h.slopingSurface() >= 0 && isWorthIt(h, ends)) add(h, ends).endSlope(step_.to_map_m);
  for (const bool restless : {false, true}) {
    const auto likeliest =
        std::find_if(bank_.begin(), bank_.end(), [&](const auto& h) { return h.restless == restless; });
    if (likeliest != bank_.end())
      add(*likeliest, (restless ? kCalm_1_s : kRestless_1_s) * step_.seconds()).restless = !restless;
  }
  bank_.insert(bank_.end(), next_.begin(), next_.end());
}

void HypothesisBank::weigh(std::span<const SurfaceSight> sights) {
  if (sights.empty()) {
    near_.clear();
    return prune();
  }
  const std::size_t most = std::min<std::size_t>(sights.size(), kSurfaces);
  // The largest surface comes last, as recognize() is about it.
  for (std::size_t number = most; number-- > 0;) {
    look(sights[number]);
    next_.clear();
    for (const GroundHypothesis& h : bank_) associate(h, sights[number], static_cast<int>(number));
    std::swap(bank_, next_);
    prune();
  }
  seen_ = step_.now;
  recognize();
  prune();
}

void HypothesisBank::look(const SurfaceSight& sight) {
  center_ = levels_.cellAt(sight.center_map_m);
  levels_.near(center_, kNeighbourhood_m, near_);
  if (config_.one_floor && (near_.empty() || near_.front() != kFloor)) near_.insert(near_.begin(), kFloor);
}

/// A small surface is part of a level only if that is known at its place. The floor may be anywhere.
bool HypothesisBank::mayBe(int level, bool small) const {
  return !small || levels_.isSame(level, kFloor) || levels_.coversAround(level, center_);
}

/// Density of the height of a surface that is no known level, where each of these has the probability 1: any between
/// the floor and the vehicle.
double HypothesisBank::unknownDensity_1_m(double vehicle_m, double height_m) const {
  return (config_.one_floor && height_m < 0.0 ? kBelowFloor : 1.0) / std::max(vehicle_m, kFlatness_m);
}

/// All that the hypothesis allows this surface to be, into next_.
void HypothesisBank::associate(const GroundHypothesis& h, const SurfaceSight& sight, int number) {
  const double noise_m2 = variance_m2(sight.beams);
  const double goes_on = std::exp(-kEdges_1_m * (step_.moved_m() + kSway_m));
  const auto goOn = [&](GroundHypothesis from, int i, double share) {
    const auto innovation = from.innovation(i, sight.center_map_m, sight.distance_below_m, noise_m2);
    if (innovation.squaredMahalanobis() > kGate2) return;
    from.log_weight += std::log(share) + innovation.logDensity();
    from.measure(i, sight.center_map_m, sight.distance_below_m, noise_m2);
    from.surfaces[static_cast<std::size_t>(i)].seenAgain(step_.now, number);
    next_.push_back(from);
  };
  bool any_before = false;
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = h.surfaces[static_cast<std::size_t>(i)];
    any_before = any_before || s.serial != 0;
    if (!s.isSeen(seen_)) continue;
    goOn(h, i, goes_on);
    const double slopes = slopeBegins();
    if (h.slopingSurface() >= 0 || !isWorthIt(h, slopes)) continue;
    GroundHypothesis sloping = h;
    const bool seen = gradient_.has_value();
    sloping.beginSlope(i, step_.from_map_m, seen ? *gradient_ : Eigen::Vector2d::Zero(),
                       square(seen ? kGradientSigma : kSteepestGradient));
    goOn(sloping, i, slopes);
  }
  meetAnother(h, sight, number, any_before ? 1.0 - goes_on : 1.0);
}

/// Probability that a slope begins in this step: not where a camera saw level ground, and in the cell where it saw one.
double HypothesisBank::slopeBegins() const {
  if (!gradient_) return kSlopes_1_m * step_.moved_m();
  return gradient_->isZero() ? 0.0 : 1.0 - std::exp(-step_.moved_m() / kSlopeCell_m);
}

/// The surface is another than those before: a known level, or unknown.
void HypothesisBank::meetAnother(const GroundHypothesis& h, const SurfaceSight& sight, int number, double share) {
  const double noise_m2 = variance_m2(sight.beams);
  GroundHypothesis another = h;
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
        h.innovationOver(level.height_m, sight.distance_below_m, noise_m2 + level.variance_m2 + square(kFlatness_m));
    if (innovation.squaredMahalanobis() > kGate2) continue;
    next_.push_back(another);
    GroundHypothesis& over = next_.back();
    over.surfaces[static_cast<std::size_t>(i)].level = id;
    over.log_weight += std::log(share) + innovation.logDensity();
    over.meetKnown(i, level.height_m, level.variance_m2);
    over.measure(i, sight.center_map_m, sight.distance_below_m, noise_m2);
  }
  const double vehicle_m = h.vertical().height_m;
  another.log_weight += std::log(share * unknownDensity_1_m(vehicle_m, vehicle_m - sight.distance_below_m));
  another.meetUnknown(i, sight.distance_below_m, noise_m2);
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
        if (s.denied_level == id || !mayBe(id, (step_.now - s.first).seconds() < kConfirmed_s)) continue;
        const LevelEstimate& level = levels_.at(id);
        const auto innovation = h.innovationOfHeight(i, level.height_m, level.variance_m2 + square(kFlatness_m));
        if (innovation.squaredMahalanobis() > kGate2) continue;
        next_.push_back(h);
        next_.back().log_weight += innovation.logDensity();
        next_.back().knowHeight(i, level.height_m, level.variance_m2);
        next_.back().surfaces[static_cast<std::size_t>(i)].level = id;
        h.log_weight += std::log(unknownDensity_1_m(h.vertical().height_m, h.height_m(i)));
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
  const VerticalState here = best().vertical();
  double agreeing = 0.0;
  for (const GroundHypothesis& h : bank_)
    if (square(h.vertical().height_m - here.height_m) <= square(kSigmas) * here.covariance(0, 0))
      agreeing += weightOf(h);
  return agreeing > 0.5;
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
