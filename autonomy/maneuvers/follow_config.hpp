// The configuration of following a person: how people walk, when a track is the person's, where a person who is not
// seen may be, and what a path behind the person costs.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

/// How people walk indoors.
struct WalkingConfig {
  double stands_m_s = 0.25;
  double slow_m_s = 0.3;
  double fast_m_s = 1.1;
  double sets_off_m_s = 0.5;
  double turns_1_s = 0.4;
  double stop_share = 0.3;
  double goes_on_share = 0.5;
  double half_width_m = 0.25;

  void describe(common::config::Fields& fields);
};

struct HiddenPersonConfig {
  int particles = 200;
  double place_sigma_m = 0.1;
  double velocity_sigma_m_s = 0.15;
  double outline_m = 0.35;
  double seen_s = 0.4;
  double explained_within_m = 0.12;
  double other_within_m = 0.5;
  double spread_m = 0.03;
  double spread_m_s = 0.05;
  double one_place_m = 0.6;

  void describe(common::config::Fields& fields);
};

struct PersonWatchConfig {
  double tracked_m = 6.0;
  double fresh_s = 0.3;
  double gate_m = 0.6;
  double least_share = 0.03;
  double least_share_in_sight = 0.3;
  double remembered_gate_m = 3.0;
  double per_speed_s = 0.5;
  WalkingConfig walking;
  HiddenPersonConfig hidden;

  void describe(common::config::Fields& fields);
};

/// Losses: a step at whose end the person is not seen, or is at a wrong distance, counts 1.
struct PursuitConfig {
  double nearer_m = 0.5;
  double farther_m = 0.7;
  double per_metre = 1.0;
  double per_square_metre = 0.3;
  double per_move = 0.03;
  double per_cost = 0.02;
  double mapped_within_m = 0.45;

  void describe(common::config::Fields& fields);
};

/// The law of the speed along the person's trail.
struct PaceConfig {
  double stands_nearer_m = 0.3;
  double headway_s = 0.6;
  double gain_1_s = 1.8;
  double ends_at_m = 1.0;
  double aside_m = 0.5;
  double gives_way_s = 1.0;

  void describe(common::config::Fields& fields);
};

struct FollowConfig {
  double replan_s = 0.2;
  double replan_m = 0.4;
  double lost_s = 3.0;
  double tolerance_m = 0.5;
  double near_s = 1.0;
  double looks_ahead_s = 8.0;
  double looks_around_deg_s = 25.0;
  PersonWatchConfig watch;
  PaceConfig pace;
  PursuitConfig pursuit;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
