// The configuration of following a person: how people walk, when a track is the person's, where a hidden person
// may be, and what a path behind the person costs.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

/// How people walk indoors.
struct WalkingConfig {
  static constexpr double stands_m_s = 0.25;   ///< A person who is slower than this stands.
  static constexpr double slow_m_s = 0.3;      ///< Least speed of a person who has turned while hidden.
  static constexpr double fast_m_s = 1.1;      ///< Greatest speed of a person who has turned while hidden.
  static constexpr double sets_off_m_s = 0.5;  ///< Speed at which a person who stands is expected to set off.
  static constexpr double turns_1_s = 0.4;   ///< Turns and stops of a walking person, per second, without an obstacle.
  static constexpr double stop_share = 0.3;  ///< Share of stops among the turns and stops of a walking person.
  static constexpr double goes_on_share =
      0.5;  ///< Probability that a person in sight goes on as before in the next seconds: straight on, or standing.
  static constexpr double half_width_m = 0.25;  ///< Half the breadth of a person's shoulders.
};

struct HiddenPersonConfig {
  static constexpr int particles = 200;         ///< Places where a hidden person may be.
  static constexpr double place_sigma_m = 0.1;  ///< Standard deviation of the place at the end of a track, per axis.
  static constexpr double velocity_sigma_m_s =
      0.15;  ///< Standard deviation of the velocity at the end of a track, per axis.
  static constexpr double outline_m =
      0.35;  ///< A beam that ends this near to the middle of a person may end on that person.
  static constexpr double seen_s = 0.4;  ///< The probability of a place falls by 1/e in this time while beams pass it,
                                         ///< and rises as fast while they end on something new there.
  static constexpr double explained_within_m = 0.12;  ///< An end point this near to something that the map showed
                                                      ///< before the person stood there is explained by it.
  static constexpr double other_within_m = 0.5;  ///< Beam ends this near to another tracked person are that person.
  static constexpr double spread_m = 0.03;       ///< Spread of the places of particles that are drawn from one.
  static constexpr double spread_m_s = 0.05;     ///< Spread of the velocities of particles that are drawn from one.
  static constexpr double one_place_m = 0.6;     ///< Particles within this distance count as one place.
};

struct PersonWatchConfig {
  double tracked_m = 6.0;                 ///< The person to be followed is at most this far away at first.
  static constexpr double fresh_s = 0.3;  ///< A track that was not seen for longer has ended.
  static constexpr double gate_m = 0.6;   ///< A track this near to a place where the person may be can be the person's.
  static constexpr double least_share =
      0.03;  ///< Least probability that a hidden person is near a track that is taken for the person's.
  static constexpr double least_share_in_sight =
      0.3;  ///< Least probability that a hidden person is near a track that is taken for the person's, while the
            ///< vehicle sees something new where the person probably stands.
  static constexpr double remembered_gate_m =
      3.0;  ///< Distance that a person who was followed earlier may have walked meanwhile.
  static constexpr double per_speed_s = 0.5;  ///< Metres of distance that a difference of 1 m/s between the velocities
                                              ///< of a track and of the person counts as.
  WalkingConfig walking;
  HiddenPersonConfig hidden;
};

/// Losses: a step at whose end the person is not seen, or is at a wrong distance, counts 1.
struct PursuitConfig {
  static constexpr double nearer_m = 0.5;   ///< Nearer than the wanted distance by more than this is wrong.
  static constexpr double farther_m = 0.7;  ///< Farther than the wanted distance by more than this is wrong.
  static constexpr double per_metre =
      1.0;  ///< Loss of a wrong distance by the metre; twice as much where it is too small. A step with a wrong
            ///< distance, or with the person out of sight, counts 1.
  static constexpr double per_square_metre = 0.3;  ///< Loss of a right distance by its squared error.
  static constexpr double per_move =
      0.03;  ///< Loss of flying for one step, so that the vehicle waits where waiting is equally good.
  static constexpr double per_cost = 0.02;  ///< Loss by the cost of a step in the cost map above that of open space.
  static constexpr double mapped_within_m =
      0.45;  ///< What the map shows this near to where the person walked is the person.
};

/// The law of the speed along the person's trail.
struct PaceConfig {
  static constexpr double stands_nearer_m =
      0.3;  ///< Behind a person who stands the distance is smaller than the wanted one by this, as the person may set
            ///< off faster than the vehicle.
  static constexpr double headway_s =
      0.6;  ///< Behind a person who walks the distance is larger by the path that the person walks in this time.
  static constexpr double gain_1_s = 1.8;   ///< Speed over that of the person by the error of the distance.
  static constexpr double ends_at_m = 1.0;  ///< The path along the trail ends at this distance from the person.
  static constexpr double aside_m =
      0.5;  ///< A place where the person walked too near to a wall is passed at most this far beside it.
  static constexpr double gives_way_s =
      1.0;  ///< The vehicle gives way to a person who comes too near within this time.
};

struct FollowConfig {
  static constexpr double replan_s = 0.2;     ///< Time between two paths.
  static constexpr double replan_m = 0.4;     ///< A place to fly to that moved by less counts as unchanged.
  static constexpr double lost_s = 3.0;       ///< A person who was not seen for longer is reported as out of sight.
  static constexpr double tolerance_m = 0.5;  ///< Tolerance of the place where a person is expected.
  static constexpr double near_s = 1.0;       ///< The vehicle has returned to a person when it was near for this long.
  static constexpr double looks_ahead_s =
      8.0;  ///< The vehicle waits ahead for a person for this long; then it turns around.
  static constexpr double looks_around_deg_s = 25.0;  ///< Yaw rate of turning around to look for the person.
  PersonWatchConfig watch;
  PaceConfig pace;
  PursuitConfig pursuit;
};

}  // namespace swiftlet::autonomy
