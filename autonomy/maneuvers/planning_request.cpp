#include "autonomy/maneuvers/planning_request.hpp"

#include <utility>

namespace swiftlet::autonomy {

PlanningRequest planningRequest(const ManeuverInput& input, const PlanningClient& client, PlanningQuestion question) {
  PlanningRequest request;
  request.intent_id = client.intent_id;
  request.grid = input.grid;
  request.levels = input.levels;
  request.discs = input.discs;
  request.keep_out = input.keep_out;
  request.footprint.clearance_m = client.clearance_m;
  request.map3d = input.map3d;
  request.names = input.names;
  request.T_map_body = input.state.T_map_body_planar();
  request.question = std::move(question);
  return request;
}

}  // namespace swiftlet::autonomy
