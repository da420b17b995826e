// A behaviour: a leaf that wishes (emits an Intent) at each tick and watches the IntentStatus of that wish.
//
// It lets go by wishing to hold until the vehicle has stopped (IntentStatus::released of that hold), or until the
// reactive layer has the vehicle anyway. Resumed, it wishes anew, with a new id.
#pragma once

#include <cstdint>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {

class FlightLeaf : public tree::Leaf {
 public:
  using Leaf::Leaf;

 protected:
  /// Emits the wish: the same id as long as nothing came between. `kind` may only change with renewWish().
  void wish(FlightTick& tick, common::IntentKind kind);
  /// The next wish() is a new one.
  void renewWish() { wish_id_ = 0; }
  /// How the present wish stands; running as long as nobody has answered it.
  common::IntentState wishState(const FlightTick& tick) const;
  /// Emits hold, as the same wish from tick to tick.
  void wishHold(FlightTick& tick);

  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;
  tree::Release onSuspend(tree::TickContext& context) override;
  tree::Release onHalt(tree::TickContext& context) override;

 private:
  std::uint64_t wish_id_ = 0;  ///< 0: none yet.
  std::uint64_t hold_id_ = 0;
};

/// A behaviour that is one wish: SUCCESS and FAILURE are those of the wish.
class IntentLeaf : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;

 protected:
  /// The wish, or why there is none.
  struct Wish {
    std::optional<common::IntentKind> kind;
    std::string problem;
  };
  /// Asked when a wish begins: at the start and after a suspension.
  virtual Wish makeWish(const FlightTick& tick) = 0;
  /// The wish under way no longer says what is meant, and begins anew.
  virtual bool isOutdated(const FlightTick&) const { return false; }

  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;

 private:
  tree::Status act(tree::TickContext& context) final;

  std::optional<common::IntentKind> kind_;
};

}  // namespace swiftlet::behaviors
