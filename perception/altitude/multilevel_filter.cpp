#include "perception/altitude/multilevel_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/square.hpp"
#include "common/vehicle_state.hpp"
#include "perception/altitude/floor_return.hpp"
#include "perception/altitude/ground_limits.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/hypothesis_bank.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/fusion/fusion_config.hpp"

namespace swiftlet::perception {

using namespace altitude;
using common::CellIndex;
using common::square;
using common::Time;

struct MultilevelFilter::Impl {
  explicit Impl(const Config& c) : config(c), store(kCell_m), bank(c, store) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Lines 14 to 17 of Algorithm 1. A level that is left is re-estimated (15) before a new one is made (14), which may
  // have its cells.
  void learnLeftLevels();
  void learnNewLevels(AltitudeUpdate& outcome);
  void extendLevels(AltitudeUpdate& outcome);
  void regainFloor(int level, const SurfaceSight& sight, AltitudeUpdate& outcome);
  void searchForLoopClosures(AltitudeUpdate& outcome);
  const SurfaceSight& sightOf(const Surface& s) const { return sights[static_cast<std::size_t>(s.sight)]; }

  Config config;
  LevelStore store;
  HypothesisBank bank;
  struct PendingCell {
    int serial;
    CellIndex cell;
  };
  std::vector<PendingCell> pending;  ///< Of surfaces that are no level yet.
  FloorReturn floor_return;
  bool initialized = false;
  bool changed = false;
  std::uint64_t version = 0;
  ScanStep step;
  std::vector<SurfaceSight> sights;
};

/// Line 15: a level that is left gets the height that was estimated together with that of the vehicle.
void MultilevelFilter::Impl::learnLeftLevels() {
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = bank.best().surfaces[static_cast<std::size_t>(i)];
    if (!s.isSeen(step.before) || s.level == kNoLevel) continue;
    LevelEstimate& level = store.at(s.level);
    if (level.variance_m2 <= 0.0) continue;  // The take-off floor defines height 0.
    level.height_m = bank.best().height_m(i);
    level.variance_m2 = std::max(bank.best().variance_m2(i), square(kFlatness_m));
    changed = true;
  }
}

/// Line 14: a surface that no level explains becomes one, unless it slopes.
void MultilevelFilter::Impl::learnNewLevels(AltitudeUpdate& outcome) {
  const GroundHypothesis best = bank.best();
  std::erase_if(pending, [&](const PendingCell& cell) {
    return std::none_of(best.surfaces.begin(), best.surfaces.end(),
                        [&](const Surface& s) { return s.serial == cell.serial; });
  });
  for (int i = 0; i < kSurfaces; ++i) {
    const Surface& s = best.surfaces[static_cast<std::size_t>(i)];
    if (!s.isSeen(step.now) || s.level != kNoLevel) continue;
    for (const CellIndex& cell : sightOf(s).cells) pending.push_back({s.serial, cell});
    if (s.slopes || (step.now - s.first).seconds() < kConfirmed_s || !bank.isSure()) continue;
    const int id = store.add(best.height_m(i), std::max(best.variance_m2(i), square(kFlatness_m)));
    for (const PendingCell& cell : pending)
      if (cell.serial == s.serial) store.extend(id, cell.cell);
    bank.nameLevel(s.serial, id);
    ++outcome.levels_added;
    changed = true;
  }
}

/// Line 16: extends the levels by the cells where they were measured.
void MultilevelFilter::Impl::extendLevels(AltitudeUpdate& outcome) {
  if (!bank.isSure()) return;
  std::optional<Surface> floor;
  for (const Surface& s : bank.best().surfaces) {
    if (!s.isSeen(step.now) || s.level == kNoLevel) continue;
    const bool is_floor = store.isSame(s.level, kFloor);
    if (is_floor) floor_return.reset();
    for (const CellIndex& cell : sightOf(s).cells) {
      if (!store.extend(s.level, cell)) continue;
      changed = true;
      if (config.one_floor && !is_floor && store.coversAround(kFloor, cell) &&
          floor_return.sawLevelOverFloor(s.level, store.centerOf(cell)))
        floor = s;
    }
  }
  if (floor) regainFloor(floor->level, sightOf(*floor), outcome);
}

/// The level is the floor: the height is the distance down to it.
void MultilevelFilter::Impl::regainFloor(int level, const SurfaceSight& sight, AltitudeUpdate& outcome) {
  VerticalState state = bank.best().vertical();
  outcome.floor_regained_m = sight.distance_below_m - state.height_m;
  state.height_m = sight.distance_below_m;
  state.covariance.row(0).setZero();
  state.covariance.col(0).setZero();
  state.covariance(0, 0) = square(config.beam_noise_m) + square(kFlatness_m);
  bank.start(state, step.now);
  (void)store.join(kFloor, level);
  std::erase(bank.near(), level);
  floor_return.reset();
  changed = true;
}

/// Line 17: merges levels that meet here and agree.
void MultilevelFilter::Impl::searchForLoopClosures(AltitudeUpdate& outcome) {
  std::vector<int>& near = bank.near();
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size();) {
      const LevelEstimate& a = store.at(near[i]);
      const LevelEstimate& b = store.at(near[j]);
      const double variance_m2 = a.variance_m2 + b.variance_m2 + 2.0 * square(kFlatness_m);
      if (square(a.height_m - b.height_m) > square(kSigmas) * variance_m2 ||
          !store.meet(near[i], near[j], bank.center(), kNeighbourhood_m)) {
        ++j;
        continue;
      }
      near[i] = store.join(near[i], near[j]);
      near.erase(near.begin() + static_cast<std::ptrdiff_t>(j));
      ++outcome.levels_joined;
      changed = true;
      j = i + 1;
    }
}

MultilevelFilter::MultilevelFilter(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
MultilevelFilter::~MultilevelFilter() = default;
MultilevelFilter::MultilevelFilter(MultilevelFilter&&) noexcept = default;
MultilevelFilter& MultilevelFilter::operator=(MultilevelFilter&&) noexcept = default;

void MultilevelFilter::initialize(Time time, const Eigen::Vector2d& position_map_m, double height_m) {
  Impl& f = *impl_;
  f.store.clear();
  f.pending.clear();
  f.floor_return.reset();
  const int floor = f.store.add(0.0, 0.0);
  const CellIndex here = f.store.cellAt(position_map_m);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) f.store.extend(floor, {here.x + x, here.y + y});
  VerticalState standing{height_m, 0.0, 0.0, {}};
  standing.covariance = Eigen::Vector3d(common::kStandingHeightSigma_m, FusionConfig::zero_velocity_sigma_m_s,
                                        FusionConfig().accelerometer_bias_sigma_m_s2)
                            .cwiseAbs2()
                            .asDiagonal();
  f.bank.start(standing, time);
  f.step = {time, time, position_map_m, position_map_m};
  f.initialized = true;
  ++f.version;
}

bool MultilevelFilter::initialized() const { return impl_->initialized; }

AltitudeUpdate MultilevelFilter::update(const GroundSight& sight) {
  Impl& f = *impl_;
  AltitudeUpdate outcome;
  if (!f.initialized || sight.stamp <= f.step.now || !sight.position_map_m.allFinite()) return outcome;
  f.step = {f.step.now, sight.stamp, f.step.to_map_m, sight.position_map_m};
  f.changed = false;

  // Stage 1: the height.
  f.bank.predict(f.step, sight.climb, sight.known, sight.at_rest, sight.gradient_map);
  f.sights = surfacesBelow(sight.points, f.store);
  f.bank.weigh(f.sights);
  if (f.sights.empty()) return outcome;

  // Stage 2: the map of levels.
  f.learnLeftLevels();
  f.learnNewLevels(outcome);
  f.extendLevels(outcome);
  f.searchForLoopClosures(outcome);
  outcome.vertical = f.bank.state();
  outcome.slopes = f.bank.best().slopingSurface() >= 0;
  outcome.height_above_ground_m = distanceToHighest_m(f.sights);
  if (f.changed) ++f.version;
  return outcome;
}

VerticalState MultilevelFilter::state() const { return impl_->bank.state(); }
common::LevelMap MultilevelFilter::levels() const { return impl_->store.snapshot(); }
std::uint64_t MultilevelFilter::levelsVersion() const { return impl_->version; }

}  // namespace swiftlet::perception
