// The maps that a mission may load, read before the flight, and what it asks for about them: LoadMap and Relocalize.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimation/flight_localizer.hpp"
#include "common/mission_request.hpp"

namespace swiftlet::autonomy {

class Estimator;
class GivenMapOverlay;

struct OfferedMap {
  std::string file;  ///< As missions name it.
  GivenMap map;
};

/// One thread; called at the ticks of the behaviours.
class MapShelf {
 public:
  void offer(std::vector<OfferedMap> maps) { maps_ = std::move(maps); }
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
