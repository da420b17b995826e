#include "perception/people/person_watch.hpp"

#include <algorithm>

#include "common/possible_walks.hpp"
#include "perception/people/dynamic_obstacles.hpp"

namespace swiftlet::perception {
namespace {

/// The trail has a point every 0.2 m, which is less than a person is wide, for the 8 m that are in view at most behind
/// the person: tracked 6 m away, followed at 2 m.
constexpr double kTrailSpacing_m = 0.2;
constexpr std::size_t kTrailPoints = 40;

/// A track that was not seen for longer has ended.
constexpr double kFresh_s = 0.3;
/// A track this near to a place where the person may be can be the person's.
constexpr double kGate_m = 0.6;
/// Least probability that a hidden person is near a track that is taken for the person's; the greater one while the
/// vehicle sees something new where the person probably stands. Without them a track in plain sight was given up, and
/// the next person who passed was followed (measured: docs/decisions/following.md).
constexpr double kLeastPersonShare = 0.03, kLeastPersonShareInSight = 0.3;
/// Distance that a person who was followed earlier may have walked meanwhile.
constexpr double kRememberedGate_m = 3.0;
/// Metres of distance that a difference of 1 m/s between the velocities of a track and of the person counts as.
constexpr double kPerSpeed_s = 0.5;

const common::DynamicObstacle* withId(std::span<const common::DynamicObstacle> obstacles, int id) {
  const auto found = std::find_if(obstacles.begin(), obstacles.end(), [&](const auto& o) { return o.id == id; });
  return found == obstacles.end() ? nullptr : &*found;
}

}  // namespace

void PersonWatch::choose(std::span<const common::DynamicObstacle> obstacles, const Eigen::Vector2d& here_map_m) {
  if (last_) return;
  const common::DynamicObstacle* nearest = nullptr;
  for (const common::DynamicObstacle& obstacle : obstacles) {
    const double distance_m = (obstacle.center_map_m - here_map_m).norm();
    if (!obstacle.moving || distance_m > DynamicObstacles::kMaxRange_m) continue;
    if (nearest == nullptr || distance_m < (nearest->center_map_m - here_map_m).norm()) nearest = &obstacle;
  }
  if (nearest != nullptr) see(*nearest);
}

void PersonWatch::update(std::span<const common::DynamicObstacle> obstacles, const Sight& sight, common::Time now) {
  if (!last_) return;
  const common::DynamicObstacle* same = withId(obstacles, last_->id);
  const bool seen = same != nullptr && (now - same->last_seen).seconds() <= kFresh_s;
  if (!grid_while_walking_ || (seen && same->believedVelocity_map_m_s().norm() > common::kStands_m_s))
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
  if (hidden_ && hidden_->inSight()) {
    last_->last_seen = now;
    addToTrail(hidden_->place_map_m());
  }
  if (const common::DynamicObstacle* found = likeliest(obstacles, now)) see(*found);
}

/// The obstacle that is the person, if any is.
const common::DynamicObstacle* PersonWatch::likeliest(std::span<const common::DynamicObstacle> obstacles,
                                                      common::Time now) const {
  double best = remembered_ ? kRememberedGate_m : kGate_m;
  const common::DynamicObstacle* found = nullptr;
  for (const common::DynamicObstacle& obstacle : obstacles) {
    if ((now - obstacle.last_seen).seconds() > kFresh_s) continue;
    double apart_m = (obstacle.center_map_m - place_map_m(now)).norm();
    if (hidden_) {
      // Another person is unlikely to be where the person probably is.
      const double share = hidden_->share(obstacle.center_map_m, kGate_m);
      if (share < (hidden_->inSight() ? kLeastPersonShareInSight : kLeastPersonShare)) continue;
      apart_m = std::min(apart_m, kGate_m * (1.0 - share));
    }
    const double unlike_m = (obstacle.believedVelocity_map_m_s() - velocity_map_m_s()).norm() * kPerSpeed_s;
    // Something that does not move yet may be a chair, unless it is just where the person is.
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

std::vector<common::PossibleWalk> PersonWatch::walks(common::Time now) const {
  if (hidden()) return hidden_->walks();
  return common::possibleWalks(place_map_m(now), velocity_map_m_s());
}

void PersonWatch::see(const common::DynamicObstacle& obstacle) {
  last_ = obstacle;
  hidden_.reset();
  remembered_ = false;
  addToTrail(obstacle.center_map_m);
}

void PersonWatch::addToTrail(const Eigen::Vector2d& place_map_m) {
  if (!trail_map_m_.empty() && (trail_map_m_.back() - place_map_m).norm() < kTrailSpacing_m) return;
  trail_map_m_.push_back(place_map_m);
  if (trail_map_m_.size() > kTrailPoints) trail_map_m_.erase(trail_map_m_.begin());
}

}  // namespace swiftlet::perception
