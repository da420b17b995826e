#include "perception/altitude/multilevel_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

void MultilevelConfig::describe(common::config::Fields& fields) {
  fields("beam_noise_m", beam_noise_m, {0.001, 0.5}, "Standard deviation of one distance, attitude error included.");
}

}  // namespace swiftlet::perception
