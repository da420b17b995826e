#include "behaviors/views_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

/// Until the frames taken there are recognized: latencies of link and job.
constexpr double kRecognized_s = 1.2;

}  // namespace

void ViewsLeaf::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  view_.reset();
  looks_since_.reset();
}

void ViewsLeaf::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  looks_since_.reset();
}

bool ViewsLeaf::lookOn(FlightTick& tick, const std::function<std::optional<common::GoToIntent>()>& next) {
  if (looks_since_) {
    emitHold(tick);
    if ((tick.flight.now - *looks_since_).seconds() < kRecognized_s) return true;
    view_.reset();
    looks_since_.reset();
  }
  if (!view_) {
    view_ = next();
    if (!view_) return false;
    renewIntent();
  }
  emitIntent(tick, *view_);
  if (intentState(tick) == common::IntentState::kSucceeded) looks_since_ = tick.flight.now;
  if (intentState(tick) == common::IntentState::kFailed) view_.reset();
  return true;
}

}  // namespace swiftlet::behaviors
