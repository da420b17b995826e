// The supervisor, tick by tick.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "autonomy/supervisor.hpp"

namespace swiftlet::autonomy {

using common::Time;

class SupervisorStory : public testing::Test {
 protected:
  const Supervision& at(double t_s, bool airborne = true) {
    return during(t_s, airborne ? common::FlightState::kFlying : common::FlightState::kLanded);
  }
  const Supervision& during(double t_s, common::FlightState flight) {
    return supervisor_.tick(Time::fromSeconds(t_s), {flight, energy_, charge_counted_on_, vertical_age_s_, drift_m_,
                                                     walls_around_, measured_, sensor_lies_, lands_});
  }
  void scanAt(double t_s) { supervisor_.surroundingsSeen(Time::fromSeconds(t_s)); }

  Supervisor supervisor_{SupervisorConfig{}};
  common::EnergyLayer energy_;
  std::string charge_counted_on_;
  double vertical_age_s_ = 0.0;
  double drift_m_ = 0.0;
  bool walls_around_ = true;
  bool measured_ = false;
  std::string sensor_lies_;
  bool lands_ = false;
};

}  // namespace swiftlet::autonomy
