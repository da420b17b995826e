// The maps that missions may load, and what they ask for about them: LoadMap and Relocalize. Every map was read before
// the mission that names it begins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/given_map.hpp"
#include "common/mission_request.hpp"

namespace swiftlet::autonomy {

class Estimator;
class GivenMapOverlay;

using common::OfferedMap;

/// One thread; called at the ticks of the behaviours.
class MapShelf {
 public:
  /// Adds the maps; one with the name of an earlier map takes its place.
  void offer(std::vector<OfferedMap> maps);
  /// Why a mission cannot load that map; empty if it can.
  std::string problemOf(const std::string& file) const;

  /// Carries out a request about the given map and answers it; every other one is for somebody else.
  std::optional<common::MissionAnswer> take(const common::MissionRequest& request, Estimator& estimator,
                                            GivenMapOverlay& overlay) const;

 private:
  const OfferedMap* find(const std::string& file) const;

  std::vector<OfferedMap> maps_;
};

}  // namespace swiftlet::autonomy
