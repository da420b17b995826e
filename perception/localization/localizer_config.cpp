#include "perception/localization/localizer_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

void LocalizerConfig::describe(common::config::Fields& fields) {
  fields.section("particles", particles, "The particle filter that follows the pose.");
}

}  // namespace swiftlet::perception
