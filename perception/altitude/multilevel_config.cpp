#include "perception/altitude/multilevel_config.hpp"

#include "common/validation.hpp"

namespace swiftlet::perception {

void MultilevelConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, "Cells of the level map.");
  fields("neighbourhood_m", neighbourhood_m, "A level known within this distance may explain a beam.");
  fields("join_distance_m", join_distance_m, "Two levels whose cells come this close meet.");
  fields("beam_noise_m", beam_noise_m, "Standard deviation of one distance, attitude error included.");
  fields("surface_noise_m", surface_noise_m, "How far a real surface is from flat.");
  fields("acceleration_noise_m_s2", acceleration_noise_m_s2, "Error of the vertical acceleration.");
  fields("gate_sigma", gate_sigma, "Half width of all confidence regions.");
  fields("cluster_gap_m", cluster_gap_m, "A wider gap between distances separates two surfaces.");
  fields("min_cluster_beams", min_cluster_beams, "Fewer unexplained beams are outliers.");
  fields("confirm_scans", confirm_scans, "Scans in a row that must see a new surface.");
  fields("confirm_s", confirm_s, "How long it must be seen for, at one height.");
  fields("confirm_moving_s", confirm_moving_s,
         "How long, when it rises or falls no faster than the error of the vertical speed.");
  fields("slope_sigma", slope_sigma, "What rises or falls by more than this many standard deviations is a slope.");
  fields("hold_off_s", hold_off_s, "How long a level is left alone after it behaved like a slope.");
  fields("enter_after_s", enter_after_s, "A level not seen for this long is entered anew.");
  fields("unknown_per_m", unknown_per_m,
         "Surfaces not known yet that may be met, a metre of height, for each known one.");
  fields("floor_weight", floor_weight, "The take-off floor is so much likelier to be met than another level.");
  fields("one_floor", one_floor, "The take-off floor may be met again anywhere, not only near where it was seen.");
  fields("least_step_down_m", least_step_down_m, "Nothing is less than this below the take-off floor.");
  fields("publish_delay_s", publish_delay_s, "A measurement that was not doubted for this long is given out.");
}

std::vector<std::string> MultilevelConfig::validate() const {
  return common::Validation()
      .within("resolution_m", resolution_m, 0.02, 1)
      .within("neighbourhood_m", neighbourhood_m, 0, 5)
      .within("join_distance_m", join_distance_m, 0, neighbourhood_m)
      .within("beam_noise_m", beam_noise_m, 0.001, 0.5)
      .within("surface_noise_m", surface_noise_m, 0.001, 0.5)
      .within("acceleration_noise_m_s2", acceleration_noise_m_s2, 0.01, 20)
      .within("gate_sigma", gate_sigma, 1, 10)
      .within("cluster_gap_m", cluster_gap_m, 0.005, 1)
      .within("min_cluster_beams", min_cluster_beams, 1, 1000)
      .within("confirm_scans", confirm_scans, 1, 1000)
      .within("confirm_s", confirm_s, 0.01, 10)
      .within("confirm_moving_s", confirm_moving_s, confirm_s, 10)
      .within("slope_sigma", slope_sigma, 1, 100)
      .within("hold_off_s", hold_off_s, 0, 10)
      .within("enter_after_s", enter_after_s, 0, 10)
      .within("unknown_per_m", unknown_per_m, 0, 100)
      .within("floor_weight", floor_weight, 0, 1000)
      .within("least_step_down_m", least_step_down_m, 0, 10)
      .within("publish_delay_s", publish_delay_s, 0, 1)
      .problems();
}

}  // namespace swiftlet::perception
