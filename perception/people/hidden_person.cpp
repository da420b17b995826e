#include "perception/people/hidden_person.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/occupied_near.hpp"
#include "common/possible_walks.hpp"
#include "common/resampling.hpp"
#include "perception/people/dynamic_obstacles.hpp"

namespace swiftlet::perception {
namespace {

/// The longest step of the particles: at 1.1 m/s, the fastest, two cells of the map, so that none passes a
/// wall.
constexpr double kStep_s = 0.1;
/// The likeliest place is searched at every eighth particle, and every tenth is a walk of pursuitPath: 20 of
/// 200, which is what it has time for.
constexpr std::size_t kEveryPlace = 8, kEveryWalk = 10;
/// Below that sum of weights by the particle the person is nowhere where the particles are.
constexpr double kNowhere = 1e-6;
/// Places where a hidden person may be.
constexpr int kParticles = 200;
/// Standard deviations, per axis, of place and velocity at the end of a track.
constexpr double kPlaceSigma_m = 0.1, kVelocitySigma_m_s = 0.15;
/// Roughening [Gordon 1993, section 4]: the spread of places and velocities of particles that are drawn from one.
constexpr double kSpread_m = 0.03, kSpread_m_s = 0.05;
/// Particles within this distance count as one place.
constexpr double kOnePlace_m = 0.6;

/// A walking person turns or stops this often without an obstacle, per second.
constexpr double kTurns_1_s = 0.4;
/// Share of stops among the turns and stops.
constexpr double kStopShare = 0.3;
/// Least and greatest speed of a person who has turned while hidden.
constexpr double kSlow_m_s = 0.3, kFast_m_s = 1.1;

/// A beam that ends this near to the middle of a person may end on that person.
constexpr double kOutline_m = 0.35;
/// The probability of a place falls by 1/e in this time while beams pass it, and rises as fast while they end on
/// something new there.
constexpr double kSeen_s = 0.4;
/// An end point this near to something that the map showed before the person stood there is explained by it.
constexpr double kExplainedByMap_m = 0.12;
/// Beam ends this near to another tracked person are that person.
constexpr double kOtherWithin_m = 0.5;

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
  const bool stands = velocity_map_m_s.norm() < common::kStands_m_s;
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
  if (sight.seen != nullptr) view_ = SeenRanges(*sight.seen);
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
  // An obstacle of the map at the particle's own place may be the person, who may walk out of it.
  const bool blocked = common::occupancy::isOccupied(grid.at(grid.cellAt(step_map_m))) &&
                       !common::occupancy::isOccupied(grid.at(grid.cellAt(particle.place_map_m)));
  if (blocked)
    turn();
  else
    particle.place_map_m = step_map_m;
}

/// Beams that pass a place show that no person is there. A beam end that the map did not show before the person
/// came, and that is no other person, is the person. One who stands for long is mapped, and after that person sets
/// off again the track begins some steps later.
void HiddenPerson::lookFor(Particle& particle, const Sight& sight, double dt_s) const {
  const Eigen::Vector2d offset_m = particle.place_map_m - view_.from_map_m();
  const double distance_m = offset_m.norm(), range_m = view_.range_m(offset_m);
  particle.shown = false;
  if (distance_m > DynamicObstacles::kMaxRange_m || range_m < distance_m - kOutline_m) return;  // Out of sight.
  const Eigen::Vector2d end_map_m = view_.from_map_m() + range_m / std::max(1e-3, distance_m) * offset_m;
  const int reach = static_cast<int>(std::lround(kExplainedByMap_m / before_->resolution_m()));
  const bool passed = range_m > distance_m + kOutline_m;
  const bool somebody_else = std::any_of(sight.others_map_m.begin(), sight.others_map_m.end(), [&](const auto& other) {
    return (other - particle.place_map_m).norm() < kOtherWithin_m;
  });
  particle.shown = !passed && !somebody_else && !common::occupiedNear(*before_, before_->cellAt(end_map_m), reach);
  particle.weight *= std::exp((particle.shown ? dt_s : -dt_s) / kSeen_s);
}

/// Systematic resampling, once half of the particles carry the weight.
void HiddenPerson::resample() {
  double sum = 0.0;
  for (const Particle& particle : particles_) sum += particle.weight;
  const auto count = static_cast<double>(particles_.size());
  if (sum < kNowhere * count) {  // No particle can be the person: they spread by walking on.
    for (Particle& particle : particles_) particle.weight = 1.0;
    return;
  }
  std::vector<double> weights;
  weights.reserve(particles_.size());
  for (const Particle& particle : particles_) weights.push_back(particle.weight / sum);
  if (common::effectiveSampleSize(weights) > 0.5 * count) return;
  std::vector<Particle> drawn;
  drawn.reserve(particles_.size());
  for (const std::size_t chosen : common::resampled(weights, random_)) {
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
  double most = -1.0;
  for (std::size_t i = 0; i < particles_.size(); i += kEveryPlace) {
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

std::vector<common::PossibleWalk> HiddenPerson::walks() const {
  std::vector<common::PossibleWalk> walks;
  for (std::size_t i = 0; i < particles_.size(); i += kEveryWalk) {
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

}  // namespace swiftlet::perception
