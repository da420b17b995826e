#include "planning/exploration/exploration_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::planning {}  // namespace swiftlet::planning
