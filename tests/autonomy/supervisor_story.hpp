// The supervisor, tick by tick.
#pragma once

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "autonomy/supervisor.hpp"

namespace swiftlet::autonomy {

using common::Time;

class SupervisorStory : public testing::Test {
 protected:
  SupervisorStory() { energy_.battery_voltage_v = 11.1; }

  const Supervision& at(double t_s, bool airborne = true) {
    return during(t_s, airborne ? common::FlightState::kFlying : common::FlightState::kLanded);
  }
  const Supervision& during(double t_s, common::FlightState flight) {
    VehicleCondition condition;
    condition.flight = flight;
    condition.energy = energy_;
    condition.gauge_fault = gauge_fault_;
    condition.vertical_age_s = vertical_age_s_;
    condition.drift_m = drift_m_;
    condition.walls_around = walls_around_;
    condition.position_measured = measured_;
    condition.sensor_lies = sensor_lies_;
    condition.lands = lands_;
    condition.goes_home = goes_home_;
    condition.people_all_round = people_all_round_;
    return supervisor_.tick(Time::fromSeconds(t_s), std::move(condition));
  }
  void scanAt(double t_s) { supervisor_.surroundingsSeen(Time::fromSeconds(t_s)); }

  common::EventLog log_;
  Supervisor supervisor_{SupervisorConfig{}, log_};
  common::EnergyLayer energy_;
  std::string gauge_fault_;
  double vertical_age_s_ = 0.0;
  double drift_m_ = 0.0;
  bool walls_around_ = true;
  bool measured_ = false;
  std::string sensor_lies_;
  bool lands_ = false;
  bool goes_home_ = false;
  std::string people_all_round_;
};

}  // namespace swiftlet::autonomy
