// A behaviour that looks with the camera at every free place of the map, the nearest unseen one first.
#pragma once

#include <optional>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/seen_places.hpp"
#include "behaviors/tree/port.hpp"

namespace swiftlet::behaviors {

class LookingLeaf : public FlightLeaf {
 public:
  using FlightLeaf::FlightLeaf;

 protected:
  static tree::PortManifest rangePort();

  /// Notes what the camera sees now; to be called at each tick.
  void see(const FlightTick& tick, double range_m);
  /// Flies on to the next unseen place. False when none is left.
  bool lookOn(FlightTick& tick, const SearchArea& area);

  /// What was seen stays seen.
  void onStart(tree::TickContext& context) override;
  void onResume(tree::TickContext& context) override;

 private:
  SeenPlaces seen_;
  std::optional<SeenPlaces::Look> look_;
  std::optional<common::Time> looks_since_;  ///< When it was there.
};

}  // namespace swiftlet::behaviors
