#include "autonomy/health/supervisor_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void SupervisorConfig::describe(common::config::Fields& fields) {
  fields("battery_land_share", battery_land_share, {0, 0.9},
         "Remaining charge at which the vehicle lands where it is.");
  fields("home_reserve_share", home_reserve_share, {0, 0.9},
         "Charge that is left at home, over that of the landing, when the vehicle turns back in time.");
  fields("least_thrust_margin", least_thrust_margin, {1, 3},
         "Greatest thrust over the weight below which the vehicle lands, while it can still climb.");
}

}  // namespace swiftlet::autonomy
