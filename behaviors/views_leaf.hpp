// A behaviour that flies from view to view, and waits at each until what the camera sees there is recognized.
#pragma once

#include <functional>
#include <optional>

#include "behaviors/flight_leaf.hpp"

namespace swiftlet::behaviors {

class ViewsLeaf : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;

 protected:
  /// Flies on; a view that cannot be reached is left for the next. `next` is asked for one when there is none. False
  /// when it has none left.
  bool lookOn(FlightTick& tick, const std::function<std::optional<common::GoToIntent>()>& next);

  void onStart(tree::TickContext& context) override;
  /// It flies to the same view again.
  void onResume(tree::TickContext& context) override;

 private:
  std::optional<common::GoToIntent> view_;
  std::optional<common::Time> looks_since_;  ///< When it was there.
};

}  // namespace swiftlet::behaviors
