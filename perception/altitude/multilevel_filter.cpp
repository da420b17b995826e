#include "perception/altitude/multilevel_filter.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "common/square.hpp"
#include "perception/altitude/floor_return.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/level_matching.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/new_surface.hpp"
#include "perception/altitude/prior_correction.hpp"

namespace swiftlet::perception {

using namespace altitude;
using common::CellIndex;
using common::square;
using common::Time;
namespace {

/// Side of a cell of the level map.
constexpr double kResolution_m = 0.10;
/// A level known within this distance may explain a beam.
constexpr double kNeighbourhood_m = 0.80;
/// Two levels whose cells come this close meet; at most kNeighbourhood_m.
constexpr double kJoinDistance_m = 0.20;
/// Error of the vertical acceleration while a surface is seen.
constexpr double kAccelerationNoise_m_s2 = 0.04;
/// Time for which a level is not used after it behaved like a slope (docs/decisions/altitude.md#008).
constexpr double kHoldOff_s = 0.3;

}  // namespace

struct MultilevelFilter::Impl {
  explicit Impl(const Config& c) : config(c), store(kResolution_m) {}

  // The steps of Algorithm 1, in its order.
  void matchBeams();
  bool leftALevel() const;
  bool withdrawMeasurements();
  std::optional<VirtualHeight> takeConfirmed();
  void distrustSlopes();
  std::optional<VirtualHeight> updateHeight(double believed_m_s);
  void addNewLevels(AltitudeUpdate& outcome);
  void updateLeftLevels();
  void extendLevels(AltitudeUpdate& outcome);
  void regainFloor(int level, AltitudeUpdate& outcome);
  void searchForLoopClosures(AltitudeUpdate& outcome);

  Neighbourhood known() const { return {config, height, store, near, now}; }
  double beamVariance(int averaged) const { return beamVariance_m2(config, averaged); }
  void learnSpeed(const NewSurface& seen);
  void enter(int id, double distance_below_m, double variance_m2);
  void learn(LevelEstimate& level, double height_m, double variance_m2);
  void publish();

  Config config;
  HeightFilter height;
  LevelStore store;
  std::vector<NewSurface> new_surfaces;
  std::deque<VirtualHeight> pending;
  PriorCorrection correction;
  FloorReturn floor_return;
  HeightState state;
  bool initialized = false;
  std::uint64_t version = 0;

  // State of the present scan.
  Time now, before;  ///< Stamps of this scan and of the last one.
  GroundScan scan;
  std::vector<int> near;
  std::vector<int> present, present_before;  ///< Levels seen in this and in the last scan.
  bool changed = false;
};

/// Line 5: assigns the beams to the levels below.
void MultilevelFilter::Impl::matchBeams() {
  store.near(scan.center, kNeighbourhood_m, near);
  if (config.one_floor && (near.empty() || near.front() != kFloor)) near.insert(near.begin(), kFloor);
  altitude::matchBeams(known(), scan);
  scan.group(store);
}

bool MultilevelFilter::Impl::leftALevel() const {
  return std::any_of(present_before.begin(), present_before.end(), [this](int id) {
    return std::none_of(scan.groups.begin(), scan.groups.end(), [id](const BeamGroup& g) { return g.level == id; });
  });
}

/// The measurements that are not published yet may have been of a slope. True if a level must be entered again.
bool MultilevelFilter::Impl::withdrawMeasurements() {
  if (correction.regained()) return false;
  pending.clear();
  const bool entered = correction.entered().has_value();
  if (entered) store.at(correction.entered()->level).seen = false;
  correction.end();
  return entered;
}

std::optional<VirtualHeight> MultilevelFilter::Impl::takeConfirmed() {
  if (pending.empty() || (now - pending.front().stamp).seconds() < config.publish_delay_s) return std::nullopt;
  const VirtualHeight oldest = pending.front();
  pending.pop_front();
  if (const auto& entered = correction.entered(); entered && oldest.stamp > entered->since) correction.end();
  return oldest;
}

/// Over a flat level the innovations are noise. Over a slope they all have one sign, each within its gate, and the
/// height would follow them. A level is therefore not used for a while after the sum of its innovations exceeds what
/// noise explains.
void MultilevelFilter::Impl::distrustSlopes() {
  const double late_scans = config.publish_delay_s / (now - before).seconds();
  std::erase_if(scan.groups, [&](const BeamGroup& g) {
    LevelEstimate& level = store.at(g.level);
    // The error of a correction is the same in each innovation, so the variance of their sum grows with the square of
    // their number. The height itself follows measurements that are `publish_delay_s` late: what the prediction errs
    // since then is shared with the innovations of that time, the less the longer ago they are.
    const double same =
        1.0 + (correction.underWay() ? 2.0 * level.innovations : std::min<double>(level.innovations, late_scans));
    ++level.innovations;
    level.innovation_sum_m += g.height_m + g.distance_below_m - height.height_m();
    level.innovation_variance_m2 += same * height.ownVariance_m2() + beamVariance(g.beams);
    if (square(level.innovation_sum_m) <= square(config.slope_sigma) * level.innovation_variance_m2) return false;
    level.forgetInnovations();
    withdrawMeasurements();
    level.distrusted_until = now + common::Duration::fromSeconds(kHoldOff_s);
    for (Beam& beam : scan.beams)
      if (beam.level == g.level) beam.level = kNoLevel;
    return true;
  });
}

/// Lines 6 to 11: one virtual measurement from all levels below the vehicle.
std::optional<VirtualHeight> MultilevelFilter::Impl::updateHeight(double believed_m_s) {
  if (scan.groups.empty()) return std::nullopt;
  double weights = 0.0, weighted_m = 0.0, white_weights = 0.0, surest_m2 = scan.groups.front().variance_m2;
  int used = 0;
  for (const BeamGroup& g : scan.groups) {
    const double white_m2 = beamVariance(g.beams), variance_m2 = white_m2 + g.variance_m2;
    weights += 1.0 / variance_m2;
    weighted_m += (g.height_m + g.distance_below_m) / variance_m2;
    white_weights += 1.0 / white_m2;
    used += g.beams;
    surest_m2 = std::min(surest_m2, g.variance_m2);
  }
  const double white_m2 = 1.0 / white_weights;
  height.update(weighted_m / weights, white_m2);
  height.setReferenceVariance(surest_m2 + square(config.surface_noise_m));
  VirtualHeight measured{now, weighted_m / weights, white_m2, std::max(0.0, 1.0 / weights - white_m2), used, {}};
  if (const auto variance_m2_s2 = correction.speedVariance_m2_s2(); variance_m2_s2 && pending.empty())
    measured.speed = {height.velocity_m_s(), *variance_m2_s2, height.velocity_m_s() - believed_m_s};
  return measured;
}

/// Corrects height and level with one innovation, d - (z - h), each by its own variance.
void MultilevelFilter::Impl::enter(int id, double distance_below_m, double variance_m2) {
  LevelEstimate& level = store.at(id);
  const double own_m = height.height_m() - distance_below_m;
  const double own_variance_m2 = height.covariance()(0, 0) + variance_m2;
  height.update(level.height_m + distance_below_m, level.variance_m2 + variance_m2);
  learn(level, own_m, own_variance_m2);
}

void MultilevelFilter::Impl::learn(LevelEstimate& level, double height_m, double variance_m2) {
  if (level.variance_m2 <= 0.0) return;  // The take-off floor defines height 0.
  const double gain = level.variance_m2 / (level.variance_m2 + variance_m2);
  level.height_m += gain * (height_m - level.height_m);
  // Levels are corrected by each other, but this update treats them as independent. The variance is therefore limited
  // by the flatness of real surfaces.
  level.variance_m2 = std::max((1.0 - gain) * level.variance_m2, square(config.surface_noise_m));
  changed = true;
}

/// If a flat surface seems to rise, the vehicle is sinking.
void MultilevelFilter::Impl::learnSpeed(const NewSurface& seen) {
  // The rate is a mean over the time the surface was seen; meanwhile the error of the speed changed by the error of the
  // acceleration.
  const double variance_m2_s2 = rateVariance_m2_s2(config, seen) +
                                square(config.surface_noise_m / seen.seenFor_s(now)) +
                                square(0.5 * kAccelerationNoise_m_s2 * seen.seenFor_s(now));
  height.updateVelocity(height.velocity_m_s() - seen.rate_m_s(), variance_m2_s2);
}

/// Line 14: turns new surfaces that are flat into levels, or enters a known level.
void MultilevelFilter::Impl::addNewLevels(AltitudeUpdate& outcome) {
  const bool alone = scan.groups.empty();
  const double height_before_m = height.height_m(), velocity_before_m_s = height.velocity_m_s();
  for (NewSurface& surface : new_surfaces) {
    // The present height on the line through all observations of the surface. At its ends, a line is as certain as the
    // mean of a quarter of its points.
    const double below_m = height_before_m - surface.heightAt_m(now);
    // Nothing else measures the height: the vehicle may climb without knowing it, over a level that is known.
    const int explained_by = alone ? likeliestLevel(known(), below_m, surface.last.beams, false) : kNoLevel;
    if (!isFlat(config, surface, now, height.covariance()(1, 1), explained_by)) continue;
    const double below_variance_m2 = 4.0 * square(config.beam_noise_m) / surface.beams + square(config.surface_noise_m);
    const bool first = alone && !correction.underWay();
    if (first) {
      height.dropReference();
      learnSpeed(surface);
    }
    int id = likeliestLevel(known(), below_m, surface.last.beams, false);
    if (id != kNoLevel) {
      enter(id, below_m, below_variance_m2);
    } else {
      id = store.add(height.height_m() - below_m, height.covariance()(0, 0) + below_variance_m2);
      near.push_back(id);
      ++outcome.levels_added;
      if (first) height.takeReference(below_variance_m2);
    }
    if (first) {
      correction.begin(EnteredLevel{id, now, height.height_m() - height_before_m,
                                    height.velocity_m_s() - velocity_before_m_s, height.covariance(),
                                    surface.seenFor_s(now) >= kConfirmMoving_s});
    }
    for (const CellIndex& cell : surface.cells) store.extend(id, cell);
    LevelEstimate& level = store.at(id);
    level.seen = true;
    level.last = surface.last;
    level.forgetInnovations();
    present.push_back(id);
    changed = true;
    surface.seen = false;
  }
  // A surface that rises or falls is not a level. It is dropped, but may flatten out later.
  std::erase_if(new_surfaces, [this](const NewSurface& c) { return !c.seen || c.seenFor_s(now) >= kLongestSight_s; });
}

/// Line 15, for levels that are left: a level that was below in the last scan and no longer is gets one more
/// measurement, relative to the levels below now. Only those are independent of it.
void MultilevelFilter::Impl::updateLeftLevels() {
  for (const int left : present_before) {
    if (std::find(present.begin(), present.end(), left) != present.end()) continue;
    LevelEstimate& level = store.at(left);
    double weights = 0.0, weighted_m = 0.0;
    for (const BeamGroup& g : scan.groups) {
      const double variance_m2 = g.variance_m2 + beamVariance(g.beams);
      weights += 1.0 / variance_m2;
      weighted_m += (g.height_m + g.distance_below_m) / variance_m2;
    }
    if (weights <= 0.0) continue;
    const double climbed_m = height.velocity_m_s() * (now - level.last.stamp).seconds();
    learn(level, weighted_m / weights - climbed_m - level.last.distance_below_m,
          1.0 / weights + beamVariance(level.last.beams));
  }
}

/// Line 16: extends the levels by the cells where they were measured.
void MultilevelFilter::Impl::extendLevels(AltitudeUpdate& outcome) {
  int floor = kNoLevel;
  for (const BeamGroup& g : scan.groups)
    if (g.level == kFloor) floor_return.reset();
  for (const Beam& beam : scan.beams) {
    if (beam.level == kNoLevel || !store.extend(beam.level, beam.cell)) continue;
    changed = true;
    if (config.one_floor && !store.isSame(beam.level, kFloor) && store.coversAround(kFloor, beam.cell) &&
        floor_return.sawLevelOverFloor(beam.level, store.centerOf(beam.cell)))
      floor = beam.level;
  }
  if (floor != kNoLevel) regainFloor(floor, outcome);
}

/// The level is the floor: the height is the distance down to it.
void MultilevelFilter::Impl::regainFloor(int level, AltitudeUpdate& outcome) {
  const auto group =
      std::find_if(scan.groups.begin(), scan.groups.end(), [&](const BeamGroup& g) { return g.level == level; });
  if (group == scan.groups.end()) return;
  const double before_m = height.height_m();
  Eigen::Matrix2d covariance = height.covariance();
  covariance << beamVariance(group->beams), 0.0, 0.0, covariance(1, 1);
  height.dropReference();
  height.assume({now, group->distance_below_m, height.velocity_m_s(), covariance});
  outcome.floor_regained_m = height.height_m() - before_m;
  pending.clear();
  correction.begin(RegainedFloor{now, covariance});
  (void)store.join(kFloor, level);
  store.at(kFloor).forgetInnovations();
  group->level = kFloor;
  std::replace(present.begin(), present.end(), level, kFloor);
  std::erase(near, level);
  floor_return.reset();
}

/// Line 17: merges levels that meet here and agree.
void MultilevelFilter::Impl::searchForLoopClosures(AltitudeUpdate& outcome) {
  if (!changed) return;
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size();) {
      const LevelEstimate& a = store.at(near[i]);
      const LevelEstimate& b = store.at(near[j]);
      const double sigma2 = a.variance_m2 + b.variance_m2 + 2.0 * square(config.surface_noise_m);
      const bool agree = square(a.height_m - b.height_m) <= square(config.gate_sigma) * sigma2 &&
                         likelierThanUnknown(near[i], a.height_m - b.height_m, sigma2);
      if (!agree || !store.meet(near[i], near[j], scan.center, kNeighbourhood_m, kJoinDistance_m)) {
        ++j;
        continue;
      }
      const int gone = near[j];
      near[i] = store.join(near[i], near[j]);
      std::replace(present.begin(), present.end(), gone, near[i]);
      near.erase(near.begin() + static_cast<std::ptrdiff_t>(j));
      ++outcome.levels_joined;
      j = i + 1;
    }
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
}

void MultilevelFilter::Impl::publish() {
  state.stamp = height.stamp();
  state.height_m = height.height_m();
  state.velocity_m_s = height.velocity_m_s();
  state.covariance = height.covariance();
  if (changed) ++version;
}

MultilevelFilter::MultilevelFilter(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
MultilevelFilter::~MultilevelFilter() = default;
MultilevelFilter::MultilevelFilter(MultilevelFilter&&) noexcept = default;
MultilevelFilter& MultilevelFilter::operator=(MultilevelFilter&&) noexcept = default;

void MultilevelFilter::initialize(Time time, const Eigen::Vector2d& position_map_m, double height_m) {
  Impl& f = *impl_;
  f.height.start(time, height_m, square(common::kStandingHeightSigma_m));
  f.store.clear();
  f.new_surfaces.clear();
  f.pending.clear();
  f.correction.end();
  f.floor_return.reset();
  f.present.clear();
  const int floor = f.store.add(0.0, 0.0);
  const CellIndex here = f.store.cellAt(position_map_m);
  const int around = static_cast<int>(std::lround(kJoinDistance_m / kResolution_m));
  for (int y = -around; y <= around; ++y)
    for (int x = -around; x <= around; ++x) f.store.extend(floor, {here.x + x, here.y + y});
  f.store.at(floor).seen = true;
  f.store.at(floor).last = {time, height_m, f.config.min_cluster_beams};
  f.initialized = true;
  f.changed = true;
  f.publish();
}

bool MultilevelFilter::initialized() const { return impl_->initialized; }

AltitudeUpdate MultilevelFilter::update(const HeightState& prior, const Eigen::Vector2d& position_map_m,
                                        std::span<const GroundPoint> points, bool over_slope) {
  Impl& f = *impl_;
  const Time time = prior.stamp;
  AltitudeUpdate outcome;
  if (!f.initialized || time <= f.height.stamp() || !position_map_m.allFinite()) return outcome;
  f.before = f.height.stamp();
  f.now = time;
  f.changed = false;
  std::swap(f.present, f.present_before);
  f.present.clear();

  // Stage 1: update the height estimate.
  f.height.assume(f.correction.applied(prior, f.height));
  f.scan.read(position_map_m, points, f.store);
  f.matchBeams();
  // The last measurements of a level that was left may have been the beginning of a slope.
  if (f.leftALevel() && !f.correction.isConfirmed() && f.withdrawMeasurements()) f.matchBeams();
  f.distrustSlopes();
  if (const auto measured = f.updateHeight(prior.velocity_m_s)) f.pending.push_back(*measured);
  outcome.measurement = f.takeConfirmed();

  // Stage 2: update the map of levels.
  for (const BeamGroup& g : f.scan.groups) f.present.push_back(g.level);
  seeNewSurfaces(f.new_surfaces, f.config, f.scan.beams, f.height.height_m(), time);
  f.addNewLevels(outcome);
  f.updateLeftLevels();
  if (over_slope) f.floor_return.reset();
  f.extendLevels(outcome);
  for (const BeamGroup& g : f.scan.groups) {
    LevelEstimate& level = f.store.at(g.level);
    level.seen = true;
    level.last = {time, g.distance_below_m, g.beams};
  }
  f.searchForLoopClosures(outcome);

  outcome.height_above_ground_m = f.scan.distanceToSurface_m(f.config.min_cluster_beams, f.config.cluster_gap_m);
  f.publish();
  return outcome;
}

const HeightState& MultilevelFilter::state() const { return impl_->state; }
common::LevelMap MultilevelFilter::levels() const { return impl_->store.snapshot(); }
std::uint64_t MultilevelFilter::levelsVersion() const { return impl_->version; }

}  // namespace swiftlet::perception
