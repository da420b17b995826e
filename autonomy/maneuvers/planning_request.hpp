// A maneuver's request to the planning, in the world that it sees.
#pragma once

#include <cstdint>

#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/planning_jobs/planning_worker.hpp"

namespace swiftlet::autonomy {

/// The intent for which a plan is requested.
struct PlanningClient {
  std::uint64_t intent_id = 0;
  double clearance_m = 0.0;  ///< Between hull and obstacle; the cost map is computed for it.
};

/// Without a question it only updates the cost map. The radius of the hull is left to the desk.
PlanningRequest planningRequest(const ManeuverInput& input, const PlanningClient& client,
                                PlanningQuestion question = {});

}  // namespace swiftlet::autonomy
