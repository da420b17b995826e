// HiddenPerson: the possible places of a hidden person, as particles. They walk on as the person did, turn and stop as
// people do, do not walk through what the map shows, and are not where the vehicle sees free space. The particle
// filter of Thrun 2005, chapter 4.3, with this absence as the measurement.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/dynamic_obstacle.hpp"
#include "common/occupancy_grid.hpp"
#include "common/random.hpp"
#include "common/time.hpp"
#include "perception/people/seen_points.hpp"

namespace swiftlet::perception {

/// The vehicle's map and what it sees.
struct Sight {
  std::shared_ptr<const common::OccupancyGrid> grid;  ///< Never null.
  const SeenPoints* seen = nullptr;                   ///< Null: no beams.
  std::vector<Eigen::Vector2d> others_map_m = {};     ///< Where other people are tracked.
};

/// One thread. In the `map` frame.
class HiddenPerson {
 public:
  /// The person was last seen at that place and time with that velocity. `before` is the map before the person stood
  /// there.
  HiddenPerson(const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& velocity_map_m_s, common::Time last_seen,
               std::shared_ptr<const common::OccupancyGrid> before);

  /// Until `now`; the person was not seen meanwhile.
  void advance(const Sight& sight, common::Time now);

  /// The likeliest place, and the velocity there.
  const Eigen::Vector2d& place_map_m() const { return place_map_m_; }
  const Eigen::Vector2d& velocity_map_m_s() const { return velocity_map_m_s_; }
  /// Some of the places where the person may be, with their velocities.
  std::vector<common::PossibleWalk> walks() const;
  /// The vehicle sees something at the likeliest place that was not there before the person. The track has ended,
  /// because the person stood until the map explained that place.
  bool inSight() const { return in_sight_; }
  /// Probability that the person is within `reach_m` of a place.
  double share(const Eigen::Vector2d& place_map_m, double reach_m) const;

 private:
  struct Particle {
    Eigen::Vector2d place_map_m, velocity_map_m_s;
    bool shown = false;  ///< Beams end there on something that was not there before the person.
    double weight = 1.0;
  };

  void walk(Particle& particle, const common::OccupancyGrid& grid, double dt_s);
  void lookFor(Particle& particle, const Sight& sight, double dt_s) const;
  void resample();
  void findLikeliest();

  SeenRanges view_;
  std::shared_ptr<const common::OccupancyGrid> before_;
  std::vector<Particle> particles_;
  common::RandomStream random_;
  common::Time now_;
  Eigen::Vector2d place_map_m_, velocity_map_m_s_;
  bool in_sight_ = false;
};

}  // namespace swiftlet::perception
