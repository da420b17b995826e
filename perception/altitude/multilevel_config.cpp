#include "perception/altitude/multilevel_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

void MultilevelConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.02, 1}, "Side of a cell of the level map.");
  fields("neighbourhood_m", neighbourhood_m, {0, 5}, "A level known within this distance may explain a beam.");
  fields("join_distance_m", join_distance_m, {0, 5},
         "Two levels whose cells come this close meet; at most neighbourhood_m.");
  fields("beam_noise_m", beam_noise_m, {0.001, 0.5}, "Standard deviation of one distance, attitude error included.");
  fields("surface_noise_m", surface_noise_m, {0.001, 0.5},
         "Standard deviation of a real surface from flat, shared by all beams of a scan.");
  fields("acceleration_noise_m_s2", acceleration_noise_m_s2, {0.01, 20},
         "Error of the vertical acceleration while a surface is seen.");
  fields("gate_sigma", gate_sigma, {1, 10}, "Half width of all confidence regions, in standard deviations.");
  fields("cluster_gap_m", cluster_gap_m, {0.005, 1},
         "A wider gap between the sorted distances separates two surfaces.");
  fields("min_cluster_beams", min_cluster_beams, {1, 1000}, "Fewer unexplained beams are outliers.");
  fields("confirm_scans", confirm_scans, {1, 1000},
         "Scans in a row that must see a new surface before it becomes a level.");
  fields("confirm_s", confirm_s, {0.01, 10},
         "Time for which a new surface must be seen at one height before it becomes a level.");
  fields("confirm_moving_s", confirm_moving_s, {0.01, 10},
         "Time for which a surface that rises or falls no faster than the error of the vertical speed must be seen; at "
         "least confirm_s.");
  fields("slope_sigma", slope_sigma, {1, 100},
         "A surface that rises or falls by more standard deviations than this is a slope and no level.");
  fields("hold_off_s", hold_off_s, {0, 10}, "Time for which a level is not used after it behaved like a slope.");
  fields("enter_after_s", enter_after_s, {0, 10},
         "A level that was not seen for this long is entered anew when it is seen again.");
  fields("unknown_per_m", unknown_per_m, {0, 100},
         "Unknown surfaces to be expected, for each metre of height and each known one.");
  fields("floor_weight", floor_weight, {0, 1000},
         "Factor by which the take-off floor is likelier to be met than another level.");
  fields("one_floor", one_floor,
         "Whether the take-off floor may be met again anywhere, not only in the neighbourhood of where it was seen.");
  fields("least_step_down_m", least_step_down_m, {0, 10}, "Nothing is less than this below the take-off floor.");
  fields("publish_delay_s", publish_delay_s, {0, 1},
         "A measurement to which nothing was objected for this long is given out.");
}

std::vector<std::string> MultilevelConfig::validate() const {
  return common::Validation()
      .atMost("join_distance_m", join_distance_m, "neighbourhood_m", neighbourhood_m)
      .atMost("confirm_s", confirm_s, "confirm_moving_s", confirm_moving_s)
      .problems();
}

}  // namespace swiftlet::perception
