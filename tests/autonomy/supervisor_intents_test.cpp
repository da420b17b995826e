// The flights of the supervisor itself.
#include "autonomy/supervisor_intents.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "common/world/vehicle_layer.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

/// The trail of an interrupted flight back has the way back in it, too.
TEST(SupervisorIntents, AFlightBackThatWasInterruptedKeepsItsPath) {
  common::EventLog log;
  Supervisor supervisor(SupervisorConfig{}, log);
  SupervisorIntents intents(0.1);
  common::VehicleLayer vehicle;
  common::TrailRecorder trail;
  const auto flyTo = [&](double from_m, double to_m) {
    const double step_m = to_m > from_m ? 0.1 : -0.1;
    for (int i = 0; i <= std::lround(std::abs(to_m - from_m) / 0.1); ++i) trail.add({from_m + i * step_m, 0.0});
    vehicle.trail = trail.trail();
  };
  const auto intentWith = [&](const common::Intent& present, std::uint64_t answered_id) {
    common::World world;
    world.vehicle = std::make_shared<const common::VehicleLayer>(vehicle);
    const common::IntentStatus status{answered_id, common::IntentState::kRunning, "", true};
    Supervision asked;
    asked.back = 1;
    return intents.flight(asked, {Time::fromSeconds(1), world, present, status, false}, supervisor).value();
  };
  flyTo(0.0, 5.0);
  const common::Intent back = intentWith(SupervisorIntents::hold(), SupervisorIntents::hold().id);
  flyTo(5.0, 3.0);
  const common::Intent again = intentWith(SupervisorIntents::hold(), SupervisorIntents::hold().id);
  EXPECT_EQ(again.id, back.id);
  EXPECT_EQ(std::get<common::RetraceIntent>(again.kind).path_map_m,
            std::get<common::RetraceIntent>(back.kind).path_map_m);
}

}  // namespace
}  // namespace swiftlet::autonomy
