#include "autonomy/maneuvers/follow_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::config::Fields;
using common::config::kPositive;

}  // namespace swiftlet::autonomy
