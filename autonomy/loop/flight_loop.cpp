#include "autonomy/loop/flight_loop.hpp"

#include <utility>

#include <fmt/format.h>

#include "autonomy/autonomy.hpp"
#include "common/mailbox.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::autonomy {

FlightLoop::FlightLoop(common::Vehicle& vehicle, Autonomy& autonomy,
                       common::LosslessQueue<common::OperatorCommand>& commands, std::vector<FlightSink*> sinks)
    : vehicle_(vehicle),
      autonomy_(autonomy),
      commands_(commands),
      feed_(autonomy, std::move(sinks)),
      now_(vehicle.now()) {}

bool FlightLoop::step(common::Time now) {
  now_ = now;
  events_.clear();
  const bool alive = vehicle_.advanceTo(now, events_);
  for (const common::SensorEvent& event : events_) {
    deliverDue(common::stampsOf(event).arrived);
    feed_.give(event);
  }
  for (const common::OperatorCommand& command : commands_.takeAll()) feed_.give(CommandInput{command, now});
  deliverDue(now);
  if (const auto setpoint = feed_.give(Tick{now})) vehicle_.apply(*setpoint);
  if (!alive)
    feed_.tell({now,
                common::Severity::kError,
                "vehicle",
                "the flight has ended",
                vehicle_.stopReason(),
                {},
                common::Concern::kFlightEnded});
  return alive;
}

void FlightLoop::deliverDue(common::Time now) {
  while (const auto delivery = autonomy_.jobs().nextDue(now)) feed_.give(*delivery);
}

void FlightLoop::finish() {
  for (const common::JobTimes& times : autonomy_.jobs().times()) {
    if (!times.tooSlow()) continue;
    feed_.tell(
        {now_, common::Severity::kWarning, "jobs", fmt::format("{} is slower than declared", times.kind),
         fmt::format("{} jobs, median {:.3f} s, 99th percentile {:.3f} s, declared {:.3f} s, {} late", times.count,
                     times.median.seconds(), times.p99.seconds(), times.declared.seconds(), times.late)});
  }
}

}  // namespace swiftlet::autonomy
