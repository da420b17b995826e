#include "autonomy/maneuvers/hidden_person.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/geometry.hpp"
#include "common/occupied_near.hpp"
#include "perception/slam2d/particle/resampling.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr int kParticles = 200;
/// How well place and velocity of a track are known.
constexpr double kPlaceSigma_m = 0.1, kVelocitySigma_m_s = 0.15;
/// So often a person turns or stops where nothing forces him, and so often a turn is a stop.
constexpr double kTurns_1_s = 0.4, kStopShare = 0.3;
/// Walking speeds indoors.
constexpr double kSlow_m_s = 0.3, kFast_m_s = 1.1;
/// Half of a person's width: what the map shows so near may be himself.
constexpr double kBody_m = 0.35;
/// A person in sight is tracked within this time.
constexpr double kTracked_s = 0.4;
/// An end point this near to something that the map showed before is explained by it.
constexpr double kExplained_m = 0.12;
/// Somebody else, and his width.
constexpr double kOther_m = 0.5;
/// Particles that stood for the same place and walk spread anew (Gordon 1993).
constexpr double kSpread_m = 0.03, kSpread_m_s = 0.05;
/// The longest step of the particles.
constexpr double kStep_s = 0.1;
/// Places so near to each other are one.
constexpr double kOnePlace_m = 0.6;

/// The degree of the bearing.
std::size_t degreeOf(const Eigen::Vector2d& way_m) {
  const double degrees = (std::atan2(way_m.y(), way_m.x()) + std::numbers::pi) / common::kRadPerDeg;
  return std::min<std::size_t>(359, static_cast<std::size_t>(std::max(0.0, degrees)));
}

}  // namespace

HiddenPerson::HiddenPerson(const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& velocity_map_m_s,
                           common::Time last_seen, std::shared_ptr<const common::OccupancyGrid> before)
    : before_(std::move(before)),
      random_(static_cast<std::uint64_t>(last_seen.nanoseconds()), "hidden person"),
      now_(last_seen),
      place_map_m_(place_map_m),
      velocity_map_m_s_(velocity_map_m_s) {
  const auto scattered = [&](const Eigen::Vector2d& mean, double sigma) {
    const double x = random_.gaussian(sigma);
    return Eigen::Vector2d(mean + Eigen::Vector2d(x, random_.gaussian(sigma)));
  };
  const bool stands = velocity_map_m_s.norm() < kStands_m_s;
  for (int i = 0; i < kParticles; ++i) {
    const Eigen::Vector2d place = scattered(place_map_m, kPlaceSigma_m);
    const Eigen::Vector2d velocity = scattered(velocity_map_m_s, kVelocitySigma_m_s);
    particles_.push_back({place, stands ? Eigen::Vector2d(0.0, 0.0) : velocity});
  }
}

void HiddenPerson::advance(const Sight& sight, common::Time now) {
  const double since_s = (now - now_).seconds();
  if (since_s <= 0.0) return;
  now_ = now;
  if (sight.seen != nullptr) view_.take(*sight.seen);
  const int steps = static_cast<int>(std::ceil(since_s / kStep_s));
  for (int i = 0; i < steps; ++i) {
    for (Particle& particle : particles_) {
      walk(particle, *sight.grid, since_s / steps);
      lookFor(particle, sight, since_s / steps);
    }
    resample();
  }
  findLikeliest();
}

void HiddenPerson::walk(Particle& particle, const common::OccupancyGrid& grid, double dt_s) {
  const auto turn = [&] {
    const double angle_rad = random_.uniform(-std::numbers::pi, std::numbers::pi);
    const double speed_m_s = random_.uniform(kSlow_m_s, kFast_m_s);
    particle.velocity_map_m_s = speed_m_s * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  };
  if (random_.chance(std::min(1.0, kTurns_1_s * dt_s))) {
    turn();
    if (random_.chance(kStopShare)) particle.velocity_map_m_s.setZero();
  }
  const Eigen::Vector2d step_map_m = particle.place_map_m + dt_s * particle.velocity_map_m_s;
  // Out of what the map shows at his own place he may walk: it may be himself.
  const bool blocked = common::occupancy::isOccupied(grid.at(grid.cellAt(step_map_m))) &&
                       !common::occupancy::isOccupied(grid.at(grid.cellAt(particle.place_map_m)));
  if (blocked)
    turn();
  else
    particle.place_map_m = step_map_m;
}

/// Beams that pass a place show that nobody is there. What they end on, if the map did not show it before him and it is
/// nobody else, is himself: a person who stands long enough is mapped, and the track of one who sets off again begins
/// some steps later.
void HiddenPerson::lookFor(Particle& particle, const Sight& sight, double dt_s) const {
  const Eigen::Vector2d way_m = particle.place_map_m - view_.from_map_m;
  const double distance_m = way_m.norm(), range_m = view_.range_m(way_m);
  particle.shown = false;
  if (distance_m > kTracked_m || range_m < distance_m - kBody_m) return;  // Out of sight.
  const Eigen::Vector2d end_map_m = view_.from_map_m + range_m / std::max(1e-3, distance_m) * way_m;
  const int reach = static_cast<int>(std::lround(kExplained_m / before_->resolution_m()));
  const bool passed = range_m > distance_m + kBody_m;
  const bool somebody_else = std::any_of(sight.others_map_m.begin(), sight.others_map_m.end(), [&](const auto& other) {
    return (other - particle.place_map_m).norm() < kOther_m;
  });
  particle.shown = !passed && !somebody_else && !common::occupiedNear(*before_, before_->cellAt(end_map_m), reach);
  particle.weight *= std::exp((particle.shown ? dt_s : -dt_s) / kTracked_s);
}

void HiddenPerson::View::take(const perception::SeenPoints& seen) {
  from_map_m = seen.from_map_m;
  ranges_m.fill(0.0);
  for (const Eigen::Vector2f& point : seen.points_map_m) {
    if (!point.allFinite()) continue;
    const Eigen::Vector2d way_m = point.cast<double>() - from_map_m;
    double& range_m = ranges_m[degreeOf(way_m)];
    range_m = range_m > 0.0 ? std::min(range_m, way_m.norm()) : way_m.norm();
  }
}

double HiddenPerson::View::range_m(const Eigen::Vector2d& way_m) const { return ranges_m[degreeOf(way_m)]; }

/// Systematic resampling, once half of the particles carry the weight.
void HiddenPerson::resample() {
  double sum = 0.0;
  for (const Particle& particle : particles_) sum += particle.weight;
  if (sum < 1e-6 * kParticles) {  // He is nowhere where he could be: the particles spread by walking on.
    for (Particle& particle : particles_) particle.weight = 1.0;
    return;
  }
  std::vector<double> weights;
  weights.reserve(particles_.size());
  for (const Particle& particle : particles_) weights.push_back(particle.weight / sum);
  if (perception::effectiveSampleSize(weights) > 0.5 * kParticles) return;
  std::vector<Particle> drawn;
  drawn.reserve(particles_.size());
  for (const std::size_t chosen : perception::resampled(weights, random_)) {
    drawn.push_back(particles_[chosen]);
    drawn.back().weight = 1.0;
    const double x_m = random_.gaussian(kSpread_m), x_m_s = random_.gaussian(kSpread_m_s);
    drawn.back().place_map_m += Eigen::Vector2d(x_m, random_.gaussian(kSpread_m));
    drawn.back().velocity_map_m_s += Eigen::Vector2d(x_m_s, random_.gaussian(kSpread_m_s));
  }
  particles_ = std::move(drawn);
}

/// The particle with the most weight around it, of some of them.
void HiddenPerson::findLikeliest() {
  constexpr std::size_t kEvery = 8;
  double most = -1.0;
  for (std::size_t i = 0; i < particles_.size(); i += kEvery) {
    double weight = 0.0, shown = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero(), velocity = Eigen::Vector2d::Zero();
    for (const Particle& other : particles_) {
      if ((other.place_map_m - particles_[i].place_map_m).norm() > kOnePlace_m) continue;
      weight += other.weight;
      if (other.shown) shown += other.weight;
      place += other.weight * other.place_map_m;
      velocity += other.weight * other.velocity_map_m_s;
    }
    if (weight <= most || weight <= 0.0) continue;
    most = weight;
    place_map_m_ = place / weight;
    velocity_map_m_s_ = velocity / weight;
    in_sight_ = shown > 0.5 * weight;
  }
}

std::vector<PossibleWalk> HiddenPerson::walks() const {
  constexpr std::size_t kEvery = 10;
  std::vector<PossibleWalk> walks;
  for (std::size_t i = 0; i < particles_.size(); i += kEvery) {
    const Particle& one = particles_[i];
    walks.push_back({one.place_map_m, one.velocity_map_m_s, std::max(1e-3, one.weight)});
  }
  return walks;
}

double HiddenPerson::share(const Eigen::Vector2d& place_map_m, double reach_m) const {
  double near = 0.0, all = 0.0;
  for (const Particle& particle : particles_) {
    all += particle.weight;
    if ((particle.place_map_m - place_map_m).norm() < reach_m) near += particle.weight;
  }
  return all > 0.0 ? near / all : 0.0;
}

}  // namespace swiftlet::autonomy
