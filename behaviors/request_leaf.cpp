#include "behaviors/request_leaf.hpp"

#include <utility>

namespace swiftlet::behaviors {

tree::Status RequestLeaf::act(tree::TickContext& context) {
  FlightTick& tick = flightTick(context);
  if (id_ == 0) {
    RequestOrProblem made = makeRequest(tick);
    if (!made) return fail(context, made.error());
    id_ = tick.request(*std::move(made));
    return tree::Status::kRunning;
  }
  const auto answer = tick.takeAnswer(id_);
  if (!answer) return tree::Status::kRunning;
  return answer->done ? tree::Status::kSuccess : fail(context, answer->reason);
}

}  // namespace swiftlet::behaviors
