// Keeps one person among the tracked obstacles, also while that person is not seen: hidden, or standing so long that
// the map explains the place. [Grzonka 2012, section IV-E detects obstacles that the map does not explain; which of
// them is the person is decided here]
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/dynamic_obstacle.hpp"
#include "common/time.hpp"
#include "perception/people/hidden_person.hpp"

namespace swiftlet::perception {

/// One thread. In the `map` frame.
///
///              a moving obstacle is near enough                 the track ends
///   unknown -----------------------------------> seen ------------------------------> hidden: particles
///                                                  ^  an obstacle where a particle is    |
///                                                  +-------------------------------------+
class PersonWatch {
 public:
  /// The nearest moving obstacle within DynamicObstacles::kMaxRange_m of `here_map_m` becomes the person, if none is
  /// chosen yet.
  void choose(std::span<const common::DynamicObstacle> obstacles, const Eigen::Vector2d& here_map_m);
  /// Follows the person through the obstacles of the present time.
  void update(std::span<const common::DynamicObstacle> obstacles, const Sight& sight, common::Time now);
  /// The person was last there, and is assumed to be until seen again; for a watch that continues an earlier one.
  void remember(const Eigen::Vector2d& place_map_m, common::Time when);

  bool known() const { return last_.has_value(); }
  /// Known: the place of the person at `now`; the likeliest place of a hidden person.
  Eigen::Vector2d place_map_m(common::Time now) const;
  Eigen::Vector2d velocity_map_m_s() const;
  /// Known: what the person may do from `now` on.
  std::vector<common::PossibleWalk> walks(common::Time now) const;
  /// The track has ended, and beams show that no person is where the person stood.
  bool hidden() const { return hidden_ && !hidden_->inSight(); }
  /// Known: the time since the person was seen, tracked or standing.
  double unseen_s(common::Time now) const { return (now - last_->last_seen).seconds(); }
  /// Where the person walked, the newest place last, at most the last 8 m.
  const std::vector<Eigen::Vector2d>& trail_map_m() const { return trail_map_m_; }

 private:
  const common::DynamicObstacle* likeliest(std::span<const common::DynamicObstacle> obstacles, common::Time now) const;
  void see(const common::DynamicObstacle& obstacle);
  void addToTrail(const Eigen::Vector2d& place_map_m);

  std::optional<common::DynamicObstacle> last_;
  std::optional<HiddenPerson> hidden_;
  bool remembered_ = false;
  std::shared_ptr<const common::OccupancyGrid> grid_while_walking_;  ///< Without the person, who stands now.
  std::vector<Eigen::Vector2d> trail_map_m_;
};

}  // namespace swiftlet::perception
