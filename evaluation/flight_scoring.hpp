// Scores a flight: measures its figures by the truth, and judges them by the criteria of its trial.
#pragma once

#include <cstdint>

#include "common/machine_use.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {

/// `wall_time_s` is the computing time; 0 if not known.
FlightScore scoreOf(const FlightRecord& record, const TrueWorld& world, const Criteria& criteria, std::int64_t seed,
                    double wall_time_s, const common::MachineUse& machine = {});

}  // namespace swiftlet::evaluation
