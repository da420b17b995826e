#include "perception/altitude/multilevel_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/validation.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/level_store.hpp"

namespace swiftlet::perception {

using altitude::HeightFilter;
using altitude::LevelEstimate;
using altitude::LevelSight;
using altitude::LevelStore;
using common::CellIndex;
using common::Time;

namespace {

constexpr double kFarthest_m = 60.0;
constexpr int kNone = -1;

double square(double x) { return x * x; }

struct Beam {
  CellIndex cell;
  double distance_below_m = 0.0;
  int level = kNone;
};

/// The beams of one scan that end on one level.
struct Group {
  int level = kNone;
  int beams = 0;
  double distance_below_m = 0.0;  ///< Mean.
  double height_m = 0.0;          ///< Of the level, and its variance, as they were before this scan.
  double variance_m2 = 0.0;
  bool entered = false;
};

/// A surface that no level explains, until enough scans have seen it.
struct Candidate {
  double height_sum_m = 0.0;
  int scans = 0;
  int beams = 0;
  bool seen = false;
  std::vector<CellIndex> cells;
  LevelSight last;
  double height_m() const { return height_sum_m / scans; }
};

}  // namespace

struct MultilevelFilter::Impl {
  explicit Impl(const Config& c)
      : config(c), height(c.acceleration_noise_m_s2, c.max_prediction_s), store(c.resolution_m) {}

  // Algorithm 1, in its order.
  void readBeams(const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points);
  void matchBeams();
  std::optional<VirtualHeight> updateHeight();
  void clusterRest(AltitudeUpdate& outcome);
  void addNewLevels(AltitudeUpdate& outcome);
  void updateLeftLevels();
  void extendLevels();
  void searchForLoopClosures(AltitudeUpdate& outcome);

  double beamVariance(int averaged) const {
    return square(config.beam_noise_m) / averaged + square(config.surface_noise_m);
  }
  void enter(const Group& group);
  void learn(LevelEstimate& level, double height_m, double variance_m2);
  std::optional<double> heightAboveGround();
  void publish();

  Config config;
  HeightFilter height;
  LevelStore store;
  std::vector<Candidate> candidates;
  HeightState state;
  bool initialized = false;
  std::uint64_t version = 0;

  // Of the present scan.
  Time now;
  CellIndex center;
  std::vector<Beam> beams;
  std::vector<int> near;
  std::vector<Group> groups;
  std::vector<double> distances;
  std::vector<int> present, present_before;  ///< Levels seen in this and in the last scan.
  bool changed = false;
};

void MultilevelFilter::Impl::readBeams(const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points) {
  beams.clear();
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  for (const GroundPoint& point : points) {
    const bool usable = point.position_map_m.allFinite() && std::isfinite(point.distance_below_m) &&
                        point.distance_below_m > 0.0 && point.distance_below_m < kFarthest_m;
    if (!usable) continue;
    beams.push_back({store.cellAt(point.position_map_m), point.distance_below_m, kNone});
    sum_m += point.position_map_m;
  }
  // The neighbourhood of what is measured; tilted, that is not below the vehicle.
  center = store.cellAt(beams.empty() ? position_map_m : Eigen::Vector2d(sum_m / static_cast<double>(beams.size())));
}

/// Line 5: the levels nearby that could have generated a beam; each beam takes the likeliest.
void MultilevelFilter::Impl::matchBeams() {
  store.near(center, config.neighbourhood_m, near);
  groups.clear();
  for (Beam& beam : beams) {
    double best = square(config.gate_sigma);
    for (const int id : near) {
      const LevelEstimate& level = store.at(id);
      const double residual_m = height.height_m() - level.height_m - beam.distance_below_m;
      const double distance2 = square(residual_m) / (height.covariance()(0, 0) + level.variance_m2 + beamVariance(1));
      if (distance2 > best) continue;
      best = distance2;
      beam.level = id;
    }
    if (beam.level == kNone) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.level == beam.level; });
    if (group == groups.end()) {
      const LevelEstimate& level = store.at(beam.level);
      const bool seen_lately = level.seen && (now - level.last.stamp).seconds() <= config.enter_after_s;
      groups.push_back({beam.level, 0, 0.0, level.height_m, level.variance_m2, !seen_lately});
      group = groups.end() - 1;
    }
    ++group->beams;
    group->distance_below_m += (beam.distance_below_m - group->distance_below_m) / group->beams;
  }
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.level < b.level; });
}

/// Lines 6 to 11: one virtual measurement of all levels the vehicle is over; a level just entered learns and teaches at
/// once.
std::optional<VirtualHeight> MultilevelFilter::Impl::updateHeight() {
  double weights = 0.0, weighted_m = 0.0, white_weights = 0.0;
  double all_weights = 0.0, all_weighted_m = 0.0, surest_m2 = -1.0;
  int used = 0;
  for (const Group& g : groups) {
    const double white_m2 = beamVariance(g.beams), variance_m2 = white_m2 + g.variance_m2;
    const double virtual_m = g.height_m + g.distance_below_m;
    if (!g.entered) {
      weights += 1.0 / variance_m2;
      weighted_m += virtual_m / variance_m2;
    }
    all_weights += 1.0 / variance_m2;
    all_weighted_m += virtual_m / variance_m2;
    white_weights += 1.0 / white_m2;
    used += g.beams;
    if (surest_m2 < 0.0 || g.variance_m2 < surest_m2) surest_m2 = g.variance_m2;
  }
  if (weights > 0.0) height.update(weighted_m / weights, 1.0 / weights);
  for (const Group& g : groups)
    if (g.entered) enter(g);
  if (groups.empty()) return std::nullopt;
  // The error of a level is the same from scan to scan: averaging scans does not make it smaller.
  height.keepVarianceAbove(surest_m2 + square(config.surface_noise_m));
  const double white_m2 = 1.0 / white_weights;
  return VirtualHeight{now, all_weighted_m / all_weights, white_m2, std::max(0.0, 1.0 / all_weights - white_m2), used};
}

/// One innovation, d - (z - h), corrects height and level, each by its own variance.
void MultilevelFilter::Impl::enter(const Group& g) {
  if (g.beams < config.min_cluster_beams && g.beams < static_cast<int>(beams.size())) return;
  LevelEstimate& level = store.at(g.level);
  const double own_m = height.height_m() - g.distance_below_m;
  const double own_variance_m2 = height.covariance()(0, 0) + beamVariance(g.beams);
  height.update(g.height_m + g.distance_below_m, g.variance_m2 + beamVariance(g.beams));
  learn(level, own_m, own_variance_m2);
}

void MultilevelFilter::Impl::learn(LevelEstimate& level, double height_m, double variance_m2) {
  if (level.variance_m2 <= 0.0) return;  // The take-off floor is where heights begin.
  const double gain = level.variance_m2 / (level.variance_m2 + variance_m2);
  level.height_m += gain * (height_m - level.height_m);
  // Levels learn from each other, which this bookkeeping takes for independent: it may not conclude more than a real
  // surface is flat.
  level.variance_m2 = std::max((1.0 - gain) * level.variance_m2, square(config.surface_noise_m));
  changed = true;
}

/// Line 13: the beams that no level explains, in sets of neighbouring distance.
void MultilevelFilter::Impl::clusterRest(AltitudeUpdate& outcome) {
  for (Candidate& candidate : candidates) candidate.seen = false;
  std::sort(beams.begin(), beams.end(), [](const Beam& a, const Beam& b) {
    return std::pair(a.distance_below_m, a.cell) < std::pair(b.distance_below_m, b.cell);
  });
  std::size_t begin = 0;
  while (begin < beams.size()) {
    if (beams[begin].level != kNone) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1, last = begin;
    double sum_m = beams[begin].distance_below_m;
    int count = 1;
    for (; end < beams.size() && beams[end].distance_below_m - beams[last].distance_below_m <= config.cluster_gap_m;
         ++end) {
      if (beams[end].level != kNone) continue;
      sum_m += beams[end].distance_below_m;
      last = end;
      ++count;
    }
    const bool enough = count >= std::min<int>(config.min_cluster_beams, static_cast<int>(beams.size()));
    if (enough) {
      const double mean_m = sum_m / count, surface_m = height.height_m() - mean_m;
      auto match = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
        return !c.seen && std::abs(c.height_m() - surface_m) <= config.cluster_gap_m;
      });
      if (match == candidates.end()) match = candidates.insert(candidates.end(), Candidate{});
      match->height_sum_m += surface_m;
      ++match->scans;
      match->beams += count;
      match->seen = true;
      match->last = {now, mean_m, count};
      for (std::size_t i = begin; i <= last; ++i)
        if (beams[i].level == kNone) match->cells.push_back(beams[i].cell);
    } else {
      outcome.beams_rejected += count;
    }
    begin = last + 1;
  }
  std::erase_if(candidates, [](const Candidate& c) { return !c.seen; });
}

/// Line 14.
void MultilevelFilter::Impl::addNewLevels(AltitudeUpdate& outcome) {
  for (Candidate& candidate : candidates) {
    if (candidate.scans < config.confirm_scans) continue;
    const double variance_m2 = height.covariance()(0, 0) + beamVariance(candidate.beams);
    const int id = store.add(candidate.height_m(), variance_m2);
    for (const CellIndex& cell : candidate.cells) store.extend(id, cell);
    LevelEstimate& level = store.at(id);
    level.seen = true;
    level.last = candidate.last;
    present.push_back(id);
    near.push_back(id);
    changed = true;
    ++outcome.levels_added;
  }
  std::erase_if(candidates, [this](const Candidate& c) { return c.scans >= config.confirm_scans; });
}

/// Line 15, the leaving half: what was below in the last scan and is not any more is measured once more, against what
/// is below now. Only that is independent of it.
void MultilevelFilter::Impl::updateLeftLevels() {
  for (const int left : present_before) {
    if (std::find(present.begin(), present.end(), left) != present.end()) continue;
    LevelEstimate& level = store.at(left);
    double weights = 0.0, weighted_m = 0.0;
    for (const Group& g : groups) {
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

/// Line 16.
void MultilevelFilter::Impl::extendLevels() {
  for (const Beam& beam : beams)
    if (beam.level != kNone && store.extend(beam.level, beam.cell)) changed = true;
}

/// Line 17: levels that meet here and agree are one.
void MultilevelFilter::Impl::searchForLoopClosures(AltitudeUpdate& outcome) {
  if (!changed) return;
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size();) {
      const LevelEstimate& a = store.at(near[i]);
      const LevelEstimate& b = store.at(near[j]);
      const double sigma2 = a.variance_m2 + b.variance_m2 + 2.0 * square(config.surface_noise_m);
      const bool agree = square(a.height_m - b.height_m) <= square(config.gate_sigma) * sigma2;
      if (!agree || !store.meet(near[i], near[j], center, config.neighbourhood_m, config.join_distance_m)) {
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

std::optional<double> MultilevelFilter::Impl::heightAboveGround() {
  distances.clear();
  for (const Beam& beam : beams) distances.push_back(beam.distance_below_m);
  std::sort(distances.begin(), distances.end());
  const std::size_t needed =
      std::min<std::size_t>(static_cast<std::size_t>(config.min_cluster_beams), distances.size());
  for (std::size_t i = 0; needed > 0 && i + needed <= distances.size(); ++i) {
    if (distances[i + needed - 1] - distances[i] > config.cluster_gap_m) continue;
    double sum_m = 0.0;
    std::size_t n = 0;
    for (std::size_t k = i; k < distances.size() && distances[k] - distances[i] <= config.cluster_gap_m; ++k, ++n)
      sum_m += distances[k];
    return sum_m / static_cast<double>(n);
  }
  return std::nullopt;
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

void MultilevelFilter::initialize(Time time, const Eigen::Vector2d& position_map_m, double height_m,
                                  double height_sigma_m) {
  Impl& f = *impl_;
  f.height.start(time, height_m, square(height_sigma_m));
  f.store.clear();
  f.candidates.clear();
  f.present.clear();
  const int floor = f.store.add(0.0, 0.0);
  const CellIndex here = f.store.cellAt(position_map_m);
  const int around = static_cast<int>(std::lround(f.config.join_distance_m / f.config.resolution_m));
  for (int y = -around; y <= around; ++y)
    for (int x = -around; x <= around; ++x) f.store.extend(floor, {here.x + x, here.y + y});
  f.initialized = true;
  f.changed = true;
  f.publish();
}

bool MultilevelFilter::initialized() const { return impl_->initialized; }

void MultilevelFilter::addAcceleration(Time time, double acceleration_up_m_s2) {
  if (impl_->initialized) impl_->height.addAcceleration(time, acceleration_up_m_s2);
}

AltitudeUpdate MultilevelFilter::update(Time time, const Eigen::Vector2d& position_map_m,
                                        std::span<const GroundPoint> points) {
  Impl& f = *impl_;
  AltitudeUpdate outcome;
  if (!f.initialized || time <= f.height.stamp() || !position_map_m.allFinite()) return outcome;
  f.now = time;
  f.changed = false;
  std::swap(f.present, f.present_before);
  f.present.clear();

  // 1st stage: update height estimate.
  f.height.predictTo(time);
  f.readBeams(position_map_m, points);
  f.matchBeams();
  outcome.measurement = f.updateHeight();

  // 2nd stage: update map.
  for (const Group& g : f.groups) f.present.push_back(g.level);
  f.clusterRest(outcome);
  f.addNewLevels(outcome);
  f.updateLeftLevels();
  f.extendLevels();
  for (const Group& g : f.groups) {
    LevelEstimate& level = f.store.at(g.level);
    level.seen = true;
    level.last = {time, g.distance_below_m, g.beams};
  }
  f.searchForLoopClosures(outcome);

  outcome.height_above_ground_m = f.heightAboveGround();
  f.publish();
  return outcome;
}

const HeightState& MultilevelFilter::state() const { return impl_->state; }
common::LevelMap MultilevelFilter::levels() const { return impl_->store.snapshot(); }
std::uint64_t MultilevelFilter::levelsVersion() const { return impl_->version; }

void MultilevelFilter::Config::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, "Cells of the level map.");
  fields("neighbourhood_m", neighbourhood_m, "A level known within this distance may explain a beam.");
  fields("join_distance_m", join_distance_m, "Two levels whose cells come this close meet.");
  fields("beam_noise_m", beam_noise_m, "Standard deviation of one distance, attitude error included.");
  fields("surface_noise_m", surface_noise_m, "How far a real surface is from flat.");
  fields("acceleration_noise_m_s2", acceleration_noise_m_s2, "Error of the vertical acceleration.");
  fields("gate_sigma", gate_sigma, "Half width of all confidence regions.");
  fields("cluster_gap_m", cluster_gap_m, "A wider gap between distances separates two surfaces.");
  fields("min_cluster_beams", min_cluster_beams, "Fewer unexplained beams are outliers.");
  fields("confirm_scans", confirm_scans, "Scans in a row that must see a new surface.");
  fields("enter_after_s", enter_after_s, "A level not seen for this long is entered anew.");
  fields("max_prediction_s", max_prediction_s, "Longer gaps between scans are predicted as if this long.");
}

std::vector<std::string> MultilevelFilter::Config::validate() const {
  return common::Validation()
      .within("resolution_m", resolution_m, 0.02, 1)
      .within("neighbourhood_m", neighbourhood_m, 0, 5)
      .within("join_distance_m", join_distance_m, 0, neighbourhood_m)
      .within("beam_noise_m", beam_noise_m, 0.001, 0.5)
      .within("surface_noise_m", surface_noise_m, 0.001, 0.5)
      .within("acceleration_noise_m_s2", acceleration_noise_m_s2, 0.01, 20)
      .within("gate_sigma", gate_sigma, 1, 10)
      .within("cluster_gap_m", cluster_gap_m, 0.005, 1)
      .within("min_cluster_beams", min_cluster_beams, 1, 1000)
      .within("confirm_scans", confirm_scans, 1, 1000)
      .within("enter_after_s", enter_after_s, 0, 10)
      .within("max_prediction_s", max_prediction_s, 0.01, 10)
      .problems();
}

}  // namespace swiftlet::perception
