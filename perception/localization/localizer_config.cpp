#include "perception/localization/localizer_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

LocalizerConfig::LocalizerConfig() = default;

void LocalizerConfig::describe(common::config::Fields& fields) {
  fields.section("field", field, "The map as scans are compared with it.");
  fields.section("particles", particles, "The particle filter that follows the pose.");
  fields.section("search", search, "The search of the whole map.");
  fields.section("support", support, "How much of a scan the map explains.");
  fields.section("lost", lost, "When the pose is no longer believed.");
  fields("generation_distance_m", generation_distance_m, {0.01, 10},
         "Distance after which the particles are weighed and drawn anew.");
  fields("generation_turn_deg", generation_turn_deg, {0.1, 180},
         "Turn after which the particles are weighed and drawn anew.");
  fields("odometry_share", odometry_share, {0, 1}, "Least error of the odometry, as a share of the distance.");
  fields("odometry_deg_per_m", odometry_deg_per_m, {0, 90}, "Least error of the odometry's heading for each metre.");
  fields("max_sigma_m", max_sigma_m, {0.05, 100}, "A pose less certain than this is not known.");
  fields("local_map_length_m", local_map_length_m, {1, 1000},
         "Length of the path whose scans are kept until the pose is known.");
  fields("local_map_spacing_m", local_map_spacing_m, {0.01, 5}, "Distance between points of the local map.");
  fields("local_map_points", local_map_points, {10, kMaxWindowPoints},
         "Points of the local map that are compared with the map.");
  fields("local_map_least_points", local_map_least_points, {5, 10'000},
         "With fewer points in the local map nothing is concluded; at most local_map_points.");
  fields("search_distance_m", search_distance_m, {0, 100}, "Distance after which the whole map is searched again.");
  fields("point_weight", point_weight, {0.001, 1},
         "Weight of a point of the local map in the likelihood, as particles.beam_weight is of a beam.");
  fields("ambiguity", ambiguity, {0, 1},
         "A pose is not believed while all other places together have more than this probability.");
  fields("least_explained", least_explained, {0, 1},
         "A pose is not believed while the map explains a smaller share of the local map.");
  fields("confirm_distance_m", confirm_distance_m, {0, 100},
         "Distance over which a pose must hold before it is believed.");
  fields("refuted_after_m", refuted_after_m, {0.1, 1000},
         "Path length over which no place fits, in excess of that over which one is convincing, after which the map is "
         "called that of another place.");
  fields("fitting", fitting, {0, 1},
         "Mean value of the likelihood field at the local map from which on a place fits it, however many others do.");
  fields("misfitting", misfitting, {0, 1},
         "Mean value of the likelihood field at the local map below which no place fits, however probable it is among "
         "those that were found; at most fitting.");
  fields("convincing_probability", convincing_probability, {0, 1},
         "A place that is this probable, and fits by more than misfitting, is convincing.");
  fields("distrust_search_s", distrust_search_s, {0, 100},
         "Time between searches of the whole map while the pose explains too little.");
  fields("elsewhere_nats", elsewhere_nats, {0, 1000},
         "A place that is likelier by this log-ratio means that the pose is lost.");
}

std::vector<std::string> LocalizerConfig::validate() const {
  return common::Validation()
      .atMost("local_map_least_points", local_map_least_points, "local_map_points", local_map_points)
      .atMost("misfitting", misfitting, "fitting", fitting)
      .problems();
}

}  // namespace swiftlet::perception
