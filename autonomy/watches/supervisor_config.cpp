#include "autonomy/watches/supervisor_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::autonomy {

using common::config::kPositive;

void SupervisorConfig::describe(common::config::Fields& fields) {
  fields("unseen_hold_s", unseen_hold_s, {0.05, 10},
         "When no sensor has seen the surroundings for this long the vehicle holds.");
  fields("unseen_land_s", unseen_land_s, {0.1, 10},
         "When no sensor has seen the surroundings for this long the vehicle lands.");
  fields("unseen_known_land_s", unseen_known_land_s, {0.1, 600},
         "When no sensor has seen the surroundings for this long while other sensors measure the position, the vehicle "
         "lands: what comes near is not seen.");
  fields("battery_land_share", battery_land_share, {0, 0.9},
         "Remaining charge at which the vehicle lands where it is.");
  fields("home_reserve_share", home_reserve_share, {0, 0.9},
         "Charge that is left at home, over that of the landing, when the vehicle turns back in time.");
  fields("home_need_factor", home_need_factor, {1, 3}, "Safety factor of the charge that the flight home takes.");
  fields("least_thrust_margin", least_thrust_margin, {1, 3},
         "Greatest thrust over the weight below which the vehicle lands, while it can still climb.");
  fields("thrust_margin_s", thrust_margin_s, {0, 60},
         "Time for which the thrust margin must have been less than least_thrust_margin before the vehicle lands.");
  fields("height_back_s", height_back_s, kPositive,
         "When the surface below has not been measured for this long the vehicle flies back along its trail.");
  fields(
      "drift_back_m", drift_back_m, kPositive,
      "Standard deviation of the position, gathered where the laser did not fix it, at which the vehicle flies back.");
  fields("drift_land_m", drift_land_m, kPositive,
         "Standard deviation of the position, gathered where the laser did not fix it, at which the vehicle lands; "
         "where there are no walls around it flies back up to twice as much.");
  fields("back_known_s", back_known_s, {0, 60},
         "Flying back ends when height and position have been known again for this long.");
  fields("pilot_silent_s", pilot_silent_s, {0.1, 60},
         "When a pilot who flies has not been heard of for this long the program has the vehicle again, and holds.");
}

std::vector<std::string> SupervisorConfig::validate() const {
  return common::Validation()
      .atMost("unseen_hold_s", unseen_hold_s, "unseen_land_s", unseen_land_s)
      .atMost("unseen_land_s", unseen_land_s, "unseen_known_land_s", unseen_known_land_s)
      .atMost("drift_back_m", drift_back_m, "drift_land_m", drift_land_m)
      .problems();
}

}  // namespace swiftlet::autonomy
