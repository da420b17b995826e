#include "behaviors/request_leaf.hpp"

#include <utility>

namespace swiftlet::behaviors {

tree::Status RequestLeaf::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (id_ == 0) {
    RequestOrProblem made = makeRequest(tick);
    if (!made.kind) return fail(context, made.problem);
    id_ = tick.request(*std::move(made.kind));
    return tree::Status::kRunning;
  }
  for (const common::MissionAnswer& answer : tick.flight.answers)
    if (answer.id == id_) return answer.done ? tree::Status::kSuccess : fail(context, answer.reason);
  return tree::Status::kRunning;
}

}  // namespace swiftlet::behaviors
