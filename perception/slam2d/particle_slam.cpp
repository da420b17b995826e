#include "perception/slam2d/particle_slam.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "common/random.hpp"
#include "common/resampling.hpp"
#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/slam2d/grid_update.hpp"
#include "perception/slam2d/particle/ancestry_tree.hpp"
#include "perception/slam2d/particle/map_match.hpp"
#include "perception/slam2d/sliced_map.hpp"
#include "perception/slam2d/surface_map.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;
using common::RandomStream;

/// A scan is taken in after this distance.
constexpr double kUpdateDistance_m = 0.3;
/// A scan is taken in after this rotation.
constexpr double kUpdateRotation_deg = 15.0;
/// A scan is taken in after this time.
constexpr double kUpdateTime_s = 2.0;
/// Least standard deviation of the motion between two scans that are taken in: what the matcher cannot know (tilt,
/// clutter).
constexpr double kMotionSigma_m = 0.004;
/// Least standard deviation of the rotation between two scans that are taken in.
constexpr double kMotionSigma_deg = 0.06;
/// Share of a scan's log-likelihood that counts: earlier scans already said the rest (measured:
/// docs/decisions/slam.md#016).
constexpr double kNewsShare = 0.25;
/// The particles are resampled when the effective ones are a smaller share of all (Grisetti, Stachniss and Burgard
/// 2007).
constexpr double kMinEffectiveShare = 0.5;
/// Time between the scans that say what has gone: shorter than a scan stands for (SlicedMap), so that none is missed.
constexpr double kPassed_s = 0.25;
/// The map does not begin with a scan of fewer points.
constexpr int kMinPoints = 30;

struct Particle {
  SurfaceMap map;
  Pose2 T_map_body;  ///< At the last scan that was taken in.
  int node = AncestryTree::kNone;
  double log_weight = 0.0;      ///< Since the last resampling.
  double log_likelihood = 0.0;  ///< Sum over all scans: how good the whole trajectory is.
};

/// Draws a pose from the Gaussian of additive errors with this covariance.
Pose2 sample(const Pose2& mean, const Eigen::Matrix3d& covariance, RandomStream& random) {
  const double x = random.gaussian(), y = random.gaussian(), yaw = random.gaussian();
  const Eigen::Vector3d error = covariance.llt().matrixL() * Eigen::Vector3d(x, y, yaw);
  return {mean.x_m + error.x(), mean.y_m + error.y(), common::wrapAngle(mean.yaw_rad + error.z())};
}

}  // namespace

struct ParticleSlam::Impl {
  explicit Impl(const ParticleSlamConfig& config_in)
      : config(config_in), published(common::makeOccupancyGrid(config_in.grid.resolution_m)), passed(config_in.grid) {}

  void begin(const ProjectedScan& scan, const Pose2& T_odom_body);
  void follow(const Pose2& T_odom_body, const Eigen::Matrix3d& covariance_since_last);
  bool isDue(common::Time now) const;
  void update(const ProjectedScan& scan);
  std::vector<GoneColumn> forget(const ProjectedScan& scan);
  void moveOn(Particle& particle, const MapMatch& match, RandomStream& random);
  void resample();
  const Particle& best() const;

  ParticleSlamConfig config;
  DrawnHeights band() const { return heightsAround(flight_height_m.value_or(0.0), config.grid); }

  std::vector<Particle> particles;
  AncestryTree ancestry;
  std::vector<common::Time> stamps;  ///< Of the scans that were taken in.
  DrawingBoard board;
  common::OccupancyGrid published;
  SlicedMap passed;  ///< Along the best trajectory; only what goes from it counts.
  std::optional<common::Time> passed_at;
  std::optional<double> flight_height_m;
  SlamCounts counts;

  // The motion since the last scan that was taken in; the same for all particles.
  Pose2 T_anchor_body;
  Eigen::Matrix3d covariance_anchor = Eigen::Matrix3d::Zero();
  Pose2 T_odom_body;
  common::Time last_stamp;
};

/// Starts all particles at the pose in odom, with one common map.
void ParticleSlam::Impl::begin(const ProjectedScan& scan, const Pose2& pose) {
  SurfaceMap map(config.grid);
  if (!flight_height_m) flight_height_m = scan.T_odom_body.position_m.z();
  map.draw(toDraw(scan, config.grid, band()), pose, board);
  const int root = ancestry.add(AncestryTree::kNone, pose);
  for (int i = 0; i < config.count; ++i) {
    if (i > 0) ancestry.hold(root);
    particles.push_back({map.snapshot(), pose, root, 0.0, 0.0});
  }
  T_odom_body = pose;
  stamps.push_back(scan.stamp);
  ++counts.key_scans;
}

/// Moves the estimate by the motion that the laser odometry has measured since the last scan.
void ParticleSlam::Impl::follow(const Pose2& T_odom_body_now, const Eigen::Matrix3d& covariance_since_last) {
  const Pose2 moved = T_anchor_body * between(T_odom_body, T_odom_body_now);
  const Eigen::Matrix3d step_covariance = stepCovarianceOrUnknown(covariance_since_last);
  covariance_anchor =
      propagated(covariance_anchor, T_anchor_body, moved, common::turned(step_covariance, T_anchor_body.yaw_rad));
  T_anchor_body = moved;
  T_odom_body = T_odom_body_now;
}

bool ParticleSlam::Impl::isDue(common::Time now) const {
  return T_anchor_body.position_m().norm() > kUpdateDistance_m ||
         std::abs(T_anchor_body.yaw_rad) > kUpdateRotation_deg * kRadPerDeg ||
         (now - stamps.back()).seconds() > kUpdateTime_s;
}

void ParticleSlam::Impl::update(const ProjectedScan& scan) {
  const std::vector<OrientedPoint> points = pointsToMatch(scan);
  const SurfaceScan drawn = toDraw(scan, config.grid, band());
  const double sigma_rad = kMotionSigma_deg * kRadPerDeg;
  Eigen::Matrix3d motion = covariance_anchor;
  motion.diagonal() +=
      Eigen::Vector3d(kMotionSigma_m * kMotionSigma_m, kMotionSigma_m * kMotionSigma_m, sigma_rad * sigma_rad);
  RandomStream random(static_cast<std::uint64_t>(config.seed), "particles", counts.key_scans);
  for (Particle& particle : particles) {
    const UncertainPose prior{particle.T_map_body * T_anchor_body, common::turned(motion, particle.T_map_body.yaw_rad)};
    moveOn(particle, matchToMap(particle.map, points, prior), random);
    ++counts.particle_matches;
    particle.map.draw(drawn, particle.T_map_body, board);
  }
  stamps.push_back(scan.stamp);
  ++counts.key_scans;
  T_anchor_body = Pose2{};
  covariance_anchor.setZero();
  resample();
}

/// Scans are taken in rarely, and a map of particles has one height: which beams passed at the height of what stood
/// there is in neither. What has gone by the rule of SlicedMap has gone from the map of every particle.
std::vector<GoneColumn> ParticleSlam::Impl::forget(const ProjectedScan& scan) {
  if (passed_at && (scan.stamp - *passed_at).seconds() < kPassed_s) return {};
  passed_at = scan.stamp;
  passed.draw(thinForDrawing(scan, config.grid), best().T_map_body * T_anchor_body);
  std::vector<GoneColumn> gone = passed.takeGone();
  if (gone.empty()) return gone;
  const common::OccupancyGrid seen = passed.atFlightHeight();
  for (const GoneColumn& column : gone) {
    const common::CellIndex at = seen.cellAt(column.place_map_m);
    // A particle that is some millimetres elsewhere has drawn the same outline into the cells beside.
    for (int y = at.y - 1; y <= at.y + 1; ++y)
      for (int x = at.x - 1; x <= at.x + 1; ++x)
        if (!common::occupancy::isOccupied(seen.at({x, y})))
          for (Particle& particle : particles) particle.map.forget({x, y});
  }
  return gone;
}

void ParticleSlam::Impl::moveOn(Particle& particle, const MapMatch& match, RandomStream& random) {
  particle.T_map_body = sample(match.T_map_body, match.covariance, random);
  const double news = kNewsShare * match.log_likelihood;
  particle.log_weight += news;
  particle.log_likelihood += news;
  const int before = particle.node;
  particle.node = ancestry.add(before, particle.T_map_body);
  ancestry.release(before);
}

void ParticleSlam::Impl::resample() {
  std::vector<double> log_weights;
  for (const Particle& particle : particles) log_weights.push_back(particle.log_weight);
  const std::vector<double> weights = common::normalizedWeights(log_weights);
  if (common::effectiveSampleSize(weights) >= kMinEffectiveShare * static_cast<double>(particles.size())) return;
  RandomStream random(static_cast<std::uint64_t>(config.seed), "resampling", counts.key_scans);
  std::vector<Particle> next;
  next.reserve(particles.size());
  for (const std::size_t index : common::resampled(weights, random)) {
    Particle& parent = particles[index];
    ancestry.hold(parent.node);
    next.push_back({parent.map.snapshot(), parent.T_map_body, parent.node, 0.0, parent.log_likelihood});
  }
  for (const Particle& particle : particles) ancestry.release(particle.node);
  particles = std::move(next);
  ++counts.resamplings;
}

const Particle& ParticleSlam::Impl::best() const {
  return *std::max_element(particles.begin(), particles.end(),
                           [](const Particle& a, const Particle& b) { return a.log_likelihood < b.log_likelihood; });
}

ParticleSlam::ParticleSlam(const ParticleSlamConfig& config) : impl_(std::make_unique<Impl>(config)) {}
ParticleSlam::~ParticleSlam() = default;
ParticleSlam::ParticleSlam(ParticleSlam&&) noexcept = default;
ParticleSlam& ParticleSlam::operator=(ParticleSlam&&) noexcept = default;

SlamUpdate ParticleSlam::addScan(const ProjectedScan& scan, const Pose2& T_odom_body,
                                 const Eigen::Matrix3d& covariance_since_last) {
  Impl& self = *impl_;
  ++self.counts.scans;
  const bool first = self.particles.empty();
  if (!isFinite(T_odom_body) || (!first && scan.stamp <= self.last_stamp) ||
      (first && static_cast<int>(scan.points_level_m.size()) < kMinPoints)) {
    ++self.counts.ignored_scans;
    return {false, false, first ? T_odom_body : T_map_body()};
  }
  self.last_stamp = scan.stamp;
  bool taken_in = first;
  if (first) {
    self.begin(scan, T_odom_body);
  } else {
    self.follow(T_odom_body, covariance_since_last);
    taken_in = self.isDue(scan.stamp);
    if (taken_in) self.update(scan);
  }
  SlamUpdate update{taken_in, taken_in, T_map_body()};
  update.gone = self.forget(scan);
  update.drawn |= !update.gone.empty();
  return update;
}

Pose2 ParticleSlam::T_map_odom() const {
  return impl_->particles.empty() ? Pose2{} : T_map_body() * impl_->T_odom_body.inverse();
}

int ParticleSlam::anchor() const { return static_cast<int>(impl_->stamps.size()) - 1; }
Pose2 ParticleSlam::T_anchor_body() const { return impl_->T_anchor_body; }

Pose2 ParticleSlam::T_map_body() const {
  return impl_->particles.empty() ? Pose2{} : impl_->best().T_map_body * impl_->T_anchor_body;
}

std::vector<PlanarSlam::KeyPose> ParticleSlam::keyPoses() const {
  std::vector<KeyPose> poses;
  if (impl_->particles.empty()) return poses;
  const std::vector<Pose2> path = impl_->ancestry.pathTo(impl_->best().node);
  poses.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) poses.push_back({impl_->stamps[i], path[i]});
  return poses;
}

bool ParticleSlam::setFlightHeight(double height_m) {
  if (std::isfinite(height_m)) impl_->flight_height_m = height_m;
  (void)impl_->passed.setFlightHeight(height_m);
  return false;
}

common::OccupancyGrid ParticleSlam::snapshot() {
  if (!impl_->particles.empty()) makeEqual(impl_->published, impl_->best().map.occupancy());
  return impl_->published.snapshot();
}

const SlamCounts& ParticleSlam::counts() const { return impl_->counts; }
std::size_t ParticleSlam::keptPoses() const { return impl_->ancestry.size(); }

}  // namespace swiftlet::perception
