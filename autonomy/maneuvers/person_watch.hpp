// Keeps one person among the tracked obstacles, also while he is not seen: hidden, or standing so long that the map
// explains him. [Grzonka 2012, section IV-E tracks obstacles; which of them is the one is decided here]
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "autonomy/maneuvers/hidden_person.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. In the `map` frame.
///
///              a moving obstacle is near enough                 his track ends
///   nobody ------------------------------------> seen ------------------------------> hidden: where he may be
///                                                  ^  an obstacle where he may be        |
///                                                  +-------------------------------------+
class PersonWatch {
 public:
  /// The nearest moving obstacle within `reach_m` of `here_map_m` becomes the person, if there is none yet.
  void choose(std::span<const common::DynamicObstacle> obstacles, const Eigen::Vector2d& here_map_m, double reach_m);
  /// Follows him through the obstacles of the present time.
  void update(std::span<const common::DynamicObstacle> obstacles, const Sight& sight, common::Time now);
  /// He was last there, and is believed to be until he is seen; for a watch that goes on from an earlier one.
  void remember(const Eigen::Vector2d& place_map_m, common::Time when);

  bool known() const { return last_.has_value(); }
  /// Known: where he is at `now`; the likeliest place while he is hidden.
  Eigen::Vector2d place_map_m(common::Time now) const;
  Eigen::Vector2d velocity_map_m_s() const;
  /// Known: what he may do from `now` on.
  std::vector<PossibleWalk> walks(common::Time now) const;
  /// His track has ended, and the map does not show him where he stood.
  bool hidden() const { return hidden_ && !hidden_->inSight(); }
  /// Known: the time since he was seen, tracked or standing.
  double unseen_s(common::Time now) const { return (now - last_->last_seen).seconds(); }
  /// Where he walked, the newest place last, at most a few metres.
  const std::vector<Eigen::Vector2d>& trail_map_m() const { return trail_map_m_; }

 private:
  const common::DynamicObstacle* likeliest(std::span<const common::DynamicObstacle> obstacles, common::Time now) const;
  void see(const common::DynamicObstacle& obstacle);

  std::optional<common::DynamicObstacle> last_;
  std::optional<HiddenPerson> hidden_;
  bool remembered_ = false;
  std::shared_ptr<const common::OccupancyGrid> grid_while_walking_;  ///< Without him where he stands now.
  std::vector<Eigen::Vector2d> trail_map_m_;
};

}  // namespace swiftlet::autonomy
