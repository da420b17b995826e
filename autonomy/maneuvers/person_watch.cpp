#include "autonomy/maneuvers/person_watch.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

/// A track older than that may be of somebody who left.
constexpr double kFresh_s = 0.3;
/// An obstacle this near to a place where he may be can be him.
constexpr double kGate_m = 0.6;
/// Least probability that he is near an obstacle that is taken for him: hidden, and standing in sight.
constexpr double kLeastShare = 0.03, kLeastShareInSight = 0.3;
/// A person who is remembered may have walked a few steps.
constexpr double kRememberedGate_m = 3.0;
/// Between two candidates the one that walks as he did is preferred: 1 m/s of difference counts as half a metre.
constexpr double kPerSpeed_s = 0.5;
/// Who stands may set off in any direction, at a speed of people indoors.
constexpr int kWaysFromRest = 6;
constexpr double kSetsOff_m_s = 0.5;
constexpr double kTrailSpacing_m = 0.2;
constexpr std::size_t kTrailPoints = 40;

const common::DynamicObstacle* withId(std::span<const common::DynamicObstacle> obstacles, int id) {
  const auto found = std::find_if(obstacles.begin(), obstacles.end(), [&](const auto& o) { return o.id == id; });
  return found == obstacles.end() ? nullptr : &*found;
}

}  // namespace

void PersonWatch::choose(std::span<const common::DynamicObstacle> obstacles, const Eigen::Vector2d& here_map_m,
                         double reach_m) {
  if (last_) return;
  const common::DynamicObstacle* nearest = nullptr;
  for (const common::DynamicObstacle& obstacle : obstacles) {
    const double distance_m = (obstacle.center_map_m - here_map_m).norm();
    if (!obstacle.moving || distance_m > reach_m) continue;
    if (nearest == nullptr || distance_m < (nearest->center_map_m - here_map_m).norm()) nearest = &obstacle;
  }
  if (nearest != nullptr) see(*nearest);
}

void PersonWatch::update(std::span<const common::DynamicObstacle> obstacles, const Sight& sight, common::Time now) {
  if (!last_) return;
  const common::DynamicObstacle* same = withId(obstacles, last_->id);
  const bool seen = same != nullptr && (now - same->last_seen).seconds() <= kFresh_s;
  if (!grid_while_walking_ || (seen && same->believedVelocity_map_m_s().norm() > HiddenPerson::kStands_m_s))
    grid_while_walking_ = sight.grid;
  if (seen) return see(*same);
  if (!hidden_ && !remembered_)
    hidden_.emplace(last_->center_map_m, last_->believedVelocity_map_m_s(), last_->last_seen, grid_while_walking_);
  if (hidden_) {
    Sight without_others = sight;
    for (const common::DynamicObstacle& obstacle : obstacles)
      if (obstacle.moving && (now - obstacle.last_seen).seconds() <= kFresh_s)
        without_others.others_map_m.push_back(obstacle.center_map_m);
    hidden_->advance(without_others, now);
  }
  if (hidden_ && hidden_->inSight()) last_->last_seen = now;
  if (const common::DynamicObstacle* found = likeliest(obstacles, now)) see(*found);
}

/// The obstacle that is he, if any is.
const common::DynamicObstacle* PersonWatch::likeliest(std::span<const common::DynamicObstacle> obstacles,
                                                      common::Time now) const {
  double best = remembered_ ? kRememberedGate_m : kGate_m;
  const common::DynamicObstacle* found = nullptr;
  for (const common::DynamicObstacle& obstacle : obstacles) {
    if ((now - obstacle.last_seen).seconds() > kFresh_s) continue;
    double apart_m = (obstacle.center_map_m - place_map_m(now)).norm();
    if (hidden_) {
      // Somebody else walks where he could have come to be by a chance; he walks where he probably is.
      const double share = hidden_->share(obstacle.center_map_m, kGate_m);
      if (share < (hidden_->inSight() ? kLeastShareInSight : kLeastShare)) continue;
      apart_m = std::min(apart_m, kGate_m * (1.0 - share));
    }
    const double unlike_m = (obstacle.believedVelocity_map_m_s() - velocity_map_m_s()).norm() * kPerSpeed_s;
    // Something that does not move yet may be a chair, unless it is just where he is.
    const double cost_m = hidden_ && obstacle.moving
                              ? apart_m
                              : apart_m + (obstacle.moving ? std::min(unlike_m, kGate_m) : 0.5 * kGate_m);
    if (cost_m >= best) continue;
    best = cost_m;
    found = &obstacle;
  }
  return found;
}

void PersonWatch::remember(const Eigen::Vector2d& place_map_m, common::Time when) {
  common::DynamicObstacle person;
  person.center_map_m = place_map_m;
  person.last_seen = when;
  see(person);
  remembered_ = true;
}

Eigen::Vector2d PersonWatch::place_map_m(common::Time now) const {
  if (hidden_) return hidden_->place_map_m();
  return last_->center_map_m + std::clamp(unseen_s(now), 0.0, kFresh_s) * last_->believedVelocity_map_m_s();
}

Eigen::Vector2d PersonWatch::velocity_map_m_s() const {
  return hidden_ ? hidden_->velocity_map_m_s() : last_->believedVelocity_map_m_s();
}

std::vector<PossibleWalk> PersonWatch::walks(common::Time now) const {
  if (hidden()) return hidden_->walks();
  const Eigen::Vector2d place_map_m = this->place_map_m(now), velocity_map_m_s = this->velocity_map_m_s();
  std::vector<PossibleWalk> walks;
  const auto walksAt = [&](const Eigen::Vector2d& ahead_m_s, double turn_deg, double weight) {
    const Eigen::Rotation2Dd turn(turn_deg * common::kRadPerDeg);
    walks.push_back({place_map_m, turn * ahead_m_s, weight});
  };
  if (velocity_map_m_s.norm() < HiddenPerson::kStands_m_s) {
    walksAt({0.0, 0.0}, 0.0, 0.5);
    for (int i = 0; i < kWaysFromRest; ++i)
      walksAt({kSetsOff_m_s, 0.0}, 360.0 / kWaysFromRest * i, 0.5 / kWaysFromRest);
    return walks;
  }
  walksAt(velocity_map_m_s, 0.0, 0.5);
  for (const double side : {-1.0, 1.0}) {
    walksAt(velocity_map_m_s, 50.0 * side, 0.15);
    walksAt(velocity_map_m_s, 100.0 * side, 0.1);
  }
  return walks;
}

void PersonWatch::see(const common::DynamicObstacle& obstacle) {
  last_ = obstacle;
  hidden_.reset();
  remembered_ = false;
  if (!trail_map_m_.empty() && (trail_map_m_.back() - obstacle.center_map_m).norm() < kTrailSpacing_m) return;
  trail_map_m_.push_back(obstacle.center_map_m);
  if (trail_map_m_.size() > kTrailPoints) trail_map_m_.erase(trail_map_m_.begin());
}

}  // namespace swiftlet::autonomy
