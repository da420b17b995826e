#include "autonomy/maneuvers/maneuver.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "perception/people/without_person.hpp"

namespace swiftlet::autonomy {

PlanningRequest planningRequest(const ManeuverInput& input, const PlanningClient& client, PlanningQuestion question,
                                const perception::PersonWatch* left_out) {
  PlanningRequest request;
  request.intent_id = client.intent_id;
  request.grid = input.grid;
  request.levels = input.levels;
  request.discs = input.discs;
  request.people = input.people;
  if (left_out != nullptr) {
    request.grid = std::make_shared<const common::OccupancyGrid>(
        perception::mapWithout(*left_out, input.now, *input.grid, input.seen));
    request.discs = perception::discsWithout(*left_out, input.now, input.discs);
  }
  request.keep_out = input.keep_out;
  request.footprint.clearance_m = client.clearance_m;
  request.map3d = input.map3d;
  request.names = input.names;
  request.T_map_body = input.state.T_map_body_planar();
  request.question = std::move(question);
  return request;
}

Progress cannot(std::string_view purpose, const control::FlightController& controller) {
  const char* state = toString(controller.state());
  if (controller.groundedReason().empty()) return Progress::failed(fmt::format("cannot {} while {}", purpose, state));
  return Progress::failed(fmt::format("cannot {}: {} because {}", purpose, state, controller.groundedReason()));
}

}  // namespace swiftlet::autonomy
