#include "autonomy/maneuvers/person_watch.hpp"

#include <algorithm>

namespace swiftlet::autonomy {
namespace {

/// A track older than that may be of somebody who left.
constexpr double kFresh_s = 0.3;
/// An obstacle this near to a place where he may be can be him.
constexpr double kGate_m = 0.6;
/// A person who is remembered may have walked a few steps.
constexpr double kRememberedGate_m = 3.0;
/// Between two candidates the one that walks as he did is preferred: 1 m/s of difference counts as half a metre.
constexpr double kPerSpeed_s = 0.5;
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
  if (!grid_while_walking_ || (!hidden_ && last_->believedVelocity_map_m_s().norm() > HiddenPerson::kStands_m_s))
    grid_while_walking_ = sight.grid;
  const common::DynamicObstacle* same = withId(obstacles, last_->id);
  if (same != nullptr && (now - same->last_seen).seconds() <= kFresh_s) return see(*same);
  if (!hidden_ && !remembered_)
    hidden_.emplace(last_->center_map_m, last_->believedVelocity_map_m_s(), last_->last_seen, grid_while_walking_);
  if (hidden_) hidden_->advance(sight, now);
  if (hidden_ && hidden_->standsInSight()) last_->last_seen = now;
  double best = remembered_ ? kRememberedGate_m : kGate_m;
  const common::DynamicObstacle* found = nullptr;
  for (const common::DynamicObstacle& obstacle : obstacles) {
    if ((now - obstacle.last_seen).seconds() > kFresh_s) continue;
    const double apart =
        hidden_ ? hidden_->distanceTo_m(obstacle.center_map_m) : (obstacle.center_map_m - last_->center_map_m).norm();
    const double unlike = (obstacle.believedVelocity_map_m_s() - velocity_map_m_s()).norm() * kPerSpeed_s;
    // Something that does not move yet may be a chair, unless it is just where he is.
    const double cost = apart + (obstacle.moving ? std::min(unlike, kGate_m) : 0.5 * kGate_m);
    if (cost >= best) continue;
    best = cost;
    found = &obstacle;
  }
  if (found != nullptr) see(*found);
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

void PersonWatch::see(const common::DynamicObstacle& obstacle) {
  last_ = obstacle;
  hidden_.reset();
  remembered_ = false;
  if (!trail_map_m_.empty() && (trail_map_m_.back() - obstacle.center_map_m).norm() < kTrailSpacing_m) return;
  trail_map_m_.push_back(obstacle.center_map_m);
  if (trail_map_m_.size() > kTrailPoints) trail_map_m_.erase(trail_map_m_.begin());
}

}  // namespace swiftlet::autonomy
