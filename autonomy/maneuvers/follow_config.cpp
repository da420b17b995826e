#include "autonomy/maneuvers/follow_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::config::Fields;
using common::config::kPositive;

void WalkingConfig::describe(Fields& fields) {
  fields("stands_m_s", stands_m_s, {0, 2}, "A person who is slower than this stands.");
  fields("slow_m_s", slow_m_s, {0, 3}, "Least speed of a person who has turned where nobody saw it.");
  fields("fast_m_s", fast_m_s, {0, 3}, "Greatest speed of a person who has turned where nobody saw it.");
  fields("sets_off_m_s", sets_off_m_s, {0, 3}, "Speed at which a person who stands is expected to set off.");
  fields("turns_1_s", turns_1_s, {0, 10},
         "Turns and stops of a walking person, per second, where nothing forces them.");
  fields("stop_share", stop_share, {0, 1}, "Share of stops among the turns and stops of a walking person.");
  fields("goes_on_share", goes_on_share, {0.01, 0.99},
         "Probability that a person in sight goes on as before in the next seconds: straight on, or standing.");
  fields("half_width_m", half_width_m, {0, 1}, "Half the breadth of a person's shoulders.");
}

void HiddenPersonConfig::describe(Fields& fields) {
  fields("particles", particles, {20, 5000}, "Places where a person who is not seen may be.");
  fields("place_sigma_m", place_sigma_m, {0, 2}, "Standard deviation of the place at the end of a track, per axis.");
  fields("velocity_sigma_m_s", velocity_sigma_m_s, {0, 2},
         "Standard deviation of the velocity at the end of a track, per axis.");
  fields("outline_m", outline_m, {0.05, 2},
         "A beam that ends this near to the middle of a person may end on that person.");
  fields(
      "seen_s", seen_s, {0.05, 10},
      "The probability of a place falls by 1/e in this time while beams pass it, and rises as fast while they end on "
      "something new there.");
  fields("explained_within_m", explained_within_m, {0, 1},
         "An end point this near to something that the map showed before the person stood there is explained by it.");
  fields("other_within_m", other_within_m, {0, 2},
         "What beams end on this near to another tracked person is that one.");
  fields("spread_m", spread_m, {0, 1}, "Spread of the places of particles that are drawn from one.");
  fields("spread_m_s", spread_m_s, {0, 1}, "Spread of the velocities of particles that are drawn from one.");
  fields("one_place_m", one_place_m, {0.05, 5}, "Particles within this distance count as one place.");
}

void PersonWatchConfig::describe(Fields& fields) {
  fields("tracked_m", tracked_m, {0.5, 100}, "The person to be followed is at most this far away at first.");
  fields("fresh_s", fresh_s, {0.02, 5}, "A track that was not seen for longer has ended.");
  fields("gate_m", gate_m, {0.05, 5}, "A track this near to a place where the person may be can be the person's.");
  fields("least_share", least_share, {0, 1},
         "Least probability that a hidden person is near a track that is taken for the person's.");
  fields("least_share_in_sight", least_share_in_sight, {0, 1},
         "Least probability that a hidden person is near a track that is taken for the person's, while the vehicle "
         "sees something new where the person probably stands.");
  fields("remembered_gate_m", remembered_gate_m, {0.05, 20},
         "Distance that a person who was followed earlier may have walked meanwhile.");
  fields(
      "per_speed_s", per_speed_s, {0, 10},
      "Metres of distance that a difference of 1 m/s between the velocities of a track and of the person counts as.");
  fields.section("walking", walking, "How people walk.");
  fields.section("hidden", hidden, "Where a person who is not seen may be.");
}

void PursuitConfig::describe(Fields& fields) {
  fields("nearer_m", nearer_m, {0.05, 5}, "Nearer than the wanted distance by more than this is wrong.");
  fields("farther_m", farther_m, {0.05, 5}, "Farther than the wanted distance by more than this is wrong.");
  fields("per_metre", per_metre, {0, 100},
         "Loss of a wrong distance by the metre; twice as much where it is too small. A step with a wrong distance, or "
         "with the person out of sight, counts 1.");
  fields("per_square_metre", per_square_metre, {0, 100}, "Loss of a right distance by its squared error.");
  fields("per_move", per_move, {0, 100},
         "Loss of flying for one step, so that the vehicle waits where that is as good.");
  fields("per_cost", per_cost, {0, 100}, "Loss by the cost of a step in the cost map above that of open space.");
  fields("mapped_within_m", mapped_within_m, {0, 2},
         "What the map shows this near to where the person walked is the person.");
}

void PaceConfig::describe(Fields& fields) {
  fields("stands_nearer_m", stands_nearer_m, {0, 1},
         "Behind a person who stands the distance is smaller than the wanted one by this, as the person may set off "
         "faster than the vehicle.");
  fields("headway_s", headway_s, {0, 5},
         "Behind a person who walks the distance is larger by the path that the person walks in this time.");
  fields("gain_1_s", gain_1_s, {0.05, 5}, "Speed over that of the person by the error of the distance.");
  fields("ends_at_m", ends_at_m, {0.5, 5}, "The path along the trail ends at this distance from the person.");
  fields("aside_m", aside_m, {0, 2},
         "A place where the person walked too near to a wall is passed at most this far beside it.");
  fields("gives_way_s", gives_way_s, {0, 5}, "The vehicle gives way to a person who comes too near within this time.");
}

void FollowConfig::describe(Fields& fields) {
  fields("replan_s", replan_s, {0.05, 5}, "Time between two paths.");
  fields("replan_m", replan_m, {0.05, 5}, "A place to fly to that moved by less is the same.");
  fields("lost_s", lost_s, kPositive, "A person who was not seen for longer is said to be out of sight.");
  fields("tolerance_m", tolerance_m, {0.05, 5}, "Tolerance of the place where a person is expected.");
  fields("near_s", near_s, {0, 60}, "The vehicle has returned to a person when it was near for this long.");
  fields("looks_ahead_s", looks_ahead_s, {0, 3600},
         "Somebody to be followed is waited for ahead for this long; then the vehicle turns around.");
  fields("looks_around_deg_s", looks_around_deg_s, {1, 180}, "Yaw rate of turning around to look for the person.");
  fields.section("watch", watch, "Which track is the person's.");
  fields.section("pace", pace, "Path and speed along the person's trail.");
  fields.section("pursuit", pursuit, "What a path behind the person costs.");
}

}  // namespace swiftlet::autonomy
