#include "simulation/walkers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/random.hpp"
#include "common/segment.hpp"

namespace swiftlet::simulation {
namespace {

using Eigen::Vector2d;

// Greatest distance beside the vehicle's path at which a crossing starts and ends.
constexpr double kSeenWalking_m = 3.0;
constexpr double kLeastStep_m = 0.8;   // Least distance beside the vehicle's path at which a crossing starts and ends.
constexpr double kLeastAhead_m = 1.5;  // No person steps into the path nearer to the vehicle than this.
constexpr double kUnderFoot_m = 0.05;  // Anything lower does not stop a person.
constexpr double kTrail_m = 0.1;       // Spacing of the remembered trail.
constexpr double kNever = std::numeric_limits<double>::infinity();

Vector2d along(const std::vector<Vector2d>& path, double walked_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double piece = (path[i] - path[i - 1]).norm();
    if (walked_m <= piece && piece > 0.0) return path[i - 1] + walked_m / piece * (path[i] - path[i - 1]);
    walked_m -= piece;
  }
  return path.back();
}

}  // namespace

Walker::Walker(const WalkerConfig& config, int seed, std::size_t number, double floor_world_m, double hull_radius_m,
               const RayCaster& rays)
    : config_(config),
      seed_(seed),
      number_(number),
      floor_world_m_(floor_world_m),
      hull_radius_m_(hull_radius_m),
      rays_(rays),
      path_start_s_(config.start_s),
      next_crossing_s_(config.start_s) {
  if (config.mode != WalkerMode::kPath) return;
  for (std::size_t i = 0; i + 1 < config.path_world_m.size(); i += 2)
    path_world_m_.emplace_back(config.path_world_m[i], config.path_world_m[i + 1]);
  if (config.at_end == WalkerEnd::kLoop) path_world_m_.push_back(path_world_m_.front());
}

void Walker::appearAt(const Vector2d& position_world_m) {
  actor_ = Actor{.position_world_m = position_world_m,
                 .radius_m = config_.radius_m,
                 .bottom_m = floor_world_m_,
                 .top_m = floor_world_m_ + config_.height_m};
}

void Walker::step(common::Time now, const WalkedAround& vehicle, double step_s) {
  const double now_s = now.seconds();
  if (now_s < config_.start_s) return;
  switch (config_.mode) {
    case WalkerMode::kPath:
      walkPath(walkedAfter_m(now_s - path_start_s_));
      return;
    case WalkerMode::kCrossPath:
      cross(now_s, vehicle);
      return;
    case WalkerMode::kFollow:
      follow(vehicle, step_s);
      return;
  }
}

double Walker::walkedAfter_m(double time_s) const {
  const std::vector<double>& speeds = config_.speeds_m_s;
  if (speeds.empty() && config_.pause_s <= 0.0) return config_.speed_m_s * time_s;
  const bool loops = config_.at_end == WalkerEnd::kLoop && common::polylineLength(path_world_m_) > 0.0;
  double walked_m = 0.0;
  for (std::size_t leg = 0;; ++leg) {
    const std::size_t i = leg % (path_world_m_.size() - 1);
    if (leg > i && !loops) return std::nextafter(walked_m, kNever);  // Beyond the end.
    const double speed_m_s = speeds.empty() ? config_.speed_m_s : speeds[i % speeds.size()];
    const double leg_m = (path_world_m_[i + 1] - path_world_m_[i]).norm();
    time_s -= config_.pause_s;
    if (time_s <= 0.0) return walked_m;
    if (speed_m_s * time_s <= leg_m) return walked_m + speed_m_s * time_s;
    time_s -= leg_m / speed_m_s;
    walked_m += leg_m;
  }
}

void Walker::walkPath(double walked_m) {
  const double whole_m = common::polylineLength(path_world_m_);
  const bool over = walked_m > whole_m;
  if (over && config_.at_end == WalkerEnd::kLeave) {
    actor_.reset();
    return;
  }
  if (over && whole_m > 0.0 && config_.at_end == WalkerEnd::kLoop) walked_m = std::fmod(walked_m, whole_m);
  if (over && whole_m > 0.0 && config_.at_end == WalkerEnd::kReturn) {
    walked_m = std::fmod(walked_m, 2.0 * whole_m);
    if (walked_m > whole_m) walked_m = 2.0 * whole_m - walked_m;
  }
  appearAt(along(path_world_m_, walked_m));
}

// Waits for the vehicle to move, walks across once, disappears, and waits again if it is to repeat.
void Walker::cross(double now_s, const WalkedAround& vehicle) {
  if (actor_) {
    const double walked_m = config_.speed_m_s * (now_s - path_start_s_);
    if (walked_m <= common::polylineLength(path_world_m_)) {
      appearAt(along(path_world_m_, walked_m));
      return;
    }
    actor_.reset();
    next_crossing_s_ = config_.repeat_s > 0.0 ? now_s + config_.repeat_s : kNever;
  }
  if (now_s < next_crossing_s_ || !planCrossing(vehicle)) return;
  ++crossings_;
  path_start_s_ = now_s;
  appearAt(path_world_m_.front());
}

bool Walker::planCrossing(const WalkedAround& vehicle) {
  const Vector2d velocity = vehicle.velocity_world_m_s.head<2>(), position = vehicle.position_world_m.head<2>();
  if (!vehicle.airborne || velocity.norm() < 0.25) return false;
  const Vector2d ahead = velocity.normalized();
  const auto freeAlong = [&](const Vector2d& from, const Vector2d& direction, double limit_m) {
    return rays_.cast({from.x(), from.y(), vehicle.position_world_m.z()}, {direction.x(), direction.y(), 0.0}, limit_m)
        .distance_m;
  };
  const double distance_m =
      std::min(config_.distance_m, freeAlong(position, ahead, 2.0 * config_.distance_m) - 2.0 * config_.radius_m);
  if (distance_m < kLeastAhead_m) return false;

  common::RandomStream random(static_cast<std::uint64_t>(seed_), "walker", 1000 * number_ + crossings_);
  Vector2d across(-ahead.y(), ahead.x());
  if (random.chance(0.5)) across = -across;
  const Vector2d middle = position + distance_m * ahead;
  const double margin_m = config_.radius_m + 0.05;
  const double before_m = std::min(kSeenWalking_m, freeAlong(middle, -across, 2.0 * kSeenWalking_m) - margin_m);
  const double after_m = std::min(kSeenWalking_m, freeAlong(middle, across, 2.0 * kSeenWalking_m) - margin_m);
  if (before_m < kLeastStep_m || after_m < kLeastStep_m) return false;
  const Vector2d from = middle - before_m * across, to = middle + after_m * across;
  // The person is in the vehicle's view from the first step.
  const Vector2d sight = from - position;
  if (freeAlong(position, sight.normalized(), sight.norm()) < sight.norm() || !freePath(from, to)) return false;
  path_world_m_ = {from, to};
  return true;
}

void Walker::follow(const WalkedAround& vehicle, double step_s) {
  const Vector2d position = vehicle.position_world_m.head<2>();
  if (vehicle.airborne && (path_world_m_.empty() || (path_world_m_.back() - position).norm() > kTrail_m))
    path_world_m_.push_back(position);
  if (path_world_m_.empty()) return;
  const double keep_m = config_.distance_m + config_.radius_m + hull_radius_m_;
  if (!actor_) {
    if ((path_world_m_.front() - position).norm() > keep_m) appearAt(path_world_m_.front());
    return;
  }
  double left_m = config_.speed_m_s * step_s;
  Vector2d next = actor_->position_world_m;
  while (left_m > 0.0 && path_world_m_.size() > 1 && (next - position).norm() > keep_m) {
    const Vector2d leg = path_world_m_.front() - next;
    const double stride_m = std::min(left_m, leg.norm());
    if (leg.norm() > 0.0) next += stride_m * leg.normalized();
    left_m -= stride_m;
    if (stride_m == leg.norm()) path_world_m_.erase(path_world_m_.begin());
    if (stride_m == 0.0 && left_m > 0.0 && path_world_m_.size() <= 1) break;
  }
  if (next != actor_->position_world_m && freePath(actor_->position_world_m, next)) appearAt(next);
}

bool Walker::freePath(const Vector2d& from_world_m, const Vector2d& to_world_m) const {
  const double half_height_m = 0.5 * (config_.height_m - kUnderFoot_m);
  const double middle_m = floor_world_m_ + kUnderFoot_m + half_height_m;
  return rays_
             .sweep({config_.radius_m, half_height_m}, {from_world_m.x(), from_world_m.y(), middle_m},
                    {to_world_m.x(), to_world_m.y(), middle_m}, 0.01)
             .shape == Hit::kNothing;
}

}  // namespace swiftlet::simulation
