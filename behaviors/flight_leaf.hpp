// A behaviour: a leaf that emits an Intent at each tick and watches the IntentStatus of that intent.
//
// To release control, it emits hold until the vehicle has stopped (IntentStatus::released of that hold), or until the
// reactive layer controls the vehicle anyway. When it resumes, it emits its intent again with a new id, as one that
// continues the one before (Intent::resumes).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {

class FlightLeaf : public tree::Leaf {
 public:
  using Leaf::Leaf;

 protected:
  /// Emits the intent, with the same id until something interrupts it. `kind` may change only after renewIntent().
  void emitIntent(FlightTick& tick, common::IntentKind kind);
  /// The next emitIntent() gets a new id and starts over.
  void renewIntent() { intent_id_ = interrupted_id_ = 0; }
  /// Status of the present intent; running until it is answered.
  common::IntentState intentState(const FlightTick& tick) const;
  /// Emits hold, as the same intent from tick to tick.
  void emitHold(FlightTick& tick);
  /// The vehicle has stopped for that hold.
  bool holdReleased(const FlightTick& tick) const {
    return hold_id_ != 0 && tick.flight.status.id == hold_id_ && tick.flight.status.released;
  }

  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Release onSuspend(tree::TickContext& context) override;
  tree::Release onHalt(tree::TickContext& context) override;

 private:
  std::uint64_t intent_id_ = 0;  ///< 0 before the first intent.
  std::uint64_t hold_id_ = 0;
  std::uint64_t interrupted_id_ = 0;  ///< The intent that a hold interrupted last; 0: none, or it starts over.
};

/// A behaviour with a single intent: SUCCESS and FAILURE are those of the intent.
class IntentLeaf : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;

 protected:
  /// The intent, or the reason why there is none.
  using IntentOrProblem = tl::expected<common::IntentKind, std::string>;
  /// Called when an intent begins: at the start and after a suspension.
  virtual IntentOrProblem makeIntent(const FlightTick& tick) = 0;
  /// Why an intent that has succeeded does not do; empty if it does.
  virtual std::string problemWith(const FlightTick&, const std::string& /*reason*/) const { return {}; }
  /// The present intent is outdated and must be emitted again.
  virtual bool isOutdated(const FlightTick&) const { return false; }

  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Release onSuspend(tree::TickContext& context) override;

 private:
  tree::Status act(tree::TickContext& context) final;
  tree::Status outcomeOf(tree::TickContext& context, common::IntentState state, const std::string& reason);

  std::optional<common::IntentKind> kind_;
  /// The intent had ended in the tick in which something interrupted it.
  std::optional<common::IntentStatus> ended_;
};

}  // namespace swiftlet::behaviors
