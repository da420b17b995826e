#include "autonomy/loop/input_feed.hpp"

#include <utility>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_sink.hpp"

namespace swiftlet::autonomy {

InputFeed::InputFeed(Autonomy& autonomy, std::vector<FlightSink*> sinks)
    : autonomy_(autonomy), sinks_(std::move(sinks)) {}

std::optional<common::Setpoint> InputFeed::give(const Input& input) {
  for (FlightSink* sink : sinks_) sink->input(input);
  const auto setpoint = autonomy_.process(input);
  if (setpoint) publish(timeOf(input), *setpoint);
  return setpoint;
}

void InputFeed::tell(common::Event event) {
  event.vehicle = autonomy_.vehicleName();
  for (FlightSink* sink : sinks_) sink->event(event);
}

void InputFeed::publish(common::Time now, const common::Setpoint& setpoint) {
  const TickOutcome outcome{
      now, setpoint, autonomy_.state(), autonomy_.intent(), autonomy_.intentStatus(), autonomy_.reference_odom_m()};
  for (FlightSink* sink : sinks_) sink->ticked(outcome);
  if (const auto world = autonomy_.world(); world != last_world_) {
    last_world_ = world;
    for (FlightSink* sink : sinks_) sink->world(world);
  }
  for (const RunFile& file : autonomy_.takeFiles())
    for (FlightSink* sink : sinks_) sink->file(file);
  for (const common::Event& event : autonomy_.takeEvents()) tell(event);
  for (const common::CommandResult& result : autonomy_.takeResults())
    for (FlightSink* sink : sinks_) sink->result(result);
}

}  // namespace swiftlet::autonomy
