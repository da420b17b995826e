#include "perception/localization/localizer_config.hpp"

#include "common/validation.hpp"

namespace swiftlet::perception {

LocalizerConfig::LocalizerConfig() = default;

void LocalizerConfig::describe(common::config::Fields& fields) {
  fields.section("field", field, "The map as it is compared with what is seen.");
  fields.section("particles", particles, "The particle filter that follows the pose.");
  fields.section("search", search, "The search of the whole map.");
  fields.section("support", support, "How much of a scan the map explains.");
  fields.section("lost", lost, "When the pose is no longer believed.");
  fields("generation_distance_m", generation_distance_m, "Way after which particles are weighed and drawn anew.");
  fields("generation_turn_deg", generation_turn_deg, "Turn after which they are.");
  fields("odometry_share", odometry_share, "Least error of the odometry, of the way.");
  fields("odometry_deg_per_m", odometry_deg_per_m, "Least error of its heading.");
  fields("max_sigma_m", max_sigma_m, "A pose less certain than this is not known.");
  fields("local_map_length_m", local_map_length_m, "Way that is kept until the pose is known.");
  fields("local_map_spacing_m", local_map_spacing_m, "Between points of the local map.");
  fields("local_map_points", local_map_points, "Points that are compared with the map.");
  fields("local_map_least_points", local_map_least_points, "With fewer nothing is concluded.");
  fields("search_distance_m", search_distance_m, "The whole map is searched again after so much way.");
  fields("point_weight", point_weight, "Weight of one point in the likelihood.");
  fields("ambiguity", ambiguity, "Probability of all other places at which a pose is not believed.");
  fields("least_explained", least_explained, "Share of the local map that the map must explain.");
  fields("confirm_distance_m", confirm_distance_m, "Way over which a pose must hold.");
  fields("distrust_search_s", distrust_search_s, "In doubt, the whole map is searched this often.");
  fields("elsewhere_nats", elsewhere_nats, "So much likelier elsewhere means lost.");
}

std::vector<std::string> LocalizerConfig::validate() const {
  return common::Validation()
      .within("generation_distance_m", generation_distance_m, 0.01, 10)
      .within("generation_turn_deg", generation_turn_deg, 0.1, 180)
      .within("odometry_share", odometry_share, 0, 1)
      .within("odometry_deg_per_m", odometry_deg_per_m, 0, 90)
      .within("max_sigma_m", max_sigma_m, 0.05, 100)
      .within("local_map_length_m", local_map_length_m, 1, 1000)
      .within("local_map_spacing_m", local_map_spacing_m, 0.01, 5)
      .within("local_map_points", local_map_points, 10, kMaxWindowPoints)
      .within("local_map_least_points", local_map_least_points, 5, local_map_points)
      .within("search_distance_m", search_distance_m, 0, 100)
      .within("point_weight", point_weight, 0.001, 1)
      .within("ambiguity", ambiguity, 0, 1)
      .within("least_explained", least_explained, 0, 1)
      .within("confirm_distance_m", confirm_distance_m, 0, 100)
      .within("distrust_search_s", distrust_search_s, 0, 100)
      .within("elsewhere_nats", elsewhere_nats, 0, 1000)
      .problems();
}

}  // namespace swiftlet::perception
