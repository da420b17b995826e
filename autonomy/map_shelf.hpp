// The maps that missions may load, and the requests about them: LoadMap and Relocalize. Every map was read before
// the mission that names it begins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autonomy/feedback.hpp"
#include "common/given_map.hpp"
#include "common/message.hpp"
#include "common/mission_request.hpp"

namespace swiftlet::autonomy {

using common::OfferedMap;

/// One thread; called at the ticks of the behaviours.
class MapShelf {
 public:
  /// Adds the maps; one with the name of an earlier map takes its place.
  void offer(std::vector<OfferedMap> maps);
  /// Why a mission cannot load that map; nullopt if it can.
  std::optional<common::Message> problemOf(const std::string& file) const;

  /// The answer to a request, and what the senses are to do for it.
  struct Answer {
    common::MissionAnswer answer;
    std::optional<GivenMapOrder> order;  ///< nullopt if the request cannot be met.
  };
  /// Answers a request about the given map; returns nullopt for any other. `given`: there is a given map.
  std::optional<Answer> take(const common::MissionRequest& request, bool given) const;

 private:
  const OfferedMap* find(const std::string& file) const;

  std::vector<OfferedMap> maps_;
};

}  // namespace swiftlet::autonomy
