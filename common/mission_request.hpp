// What a behaviour asks of the flight beside its intent: something that is done at once, or with the next camera frame.
// Each request is answered once, at a later tick of the behaviours.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/polygon.hpp"

namespace swiftlet::common {

/// The vehicle keeps out of the area for the rest of the flight.
struct KeepOutRequest {
  Polygon area;
};

using MissionRequestKind = std::variant<KeepOutRequest>;

struct MissionRequest {
  std::uint64_t id = 0;  ///< The ids of one mission rise from 1.
  MissionRequestKind kind;
};

struct MissionAnswer {
  std::uint64_t id = 0;  ///< Of the request.
  bool done = false;
  std::string reason;  ///< For people: what was done, or why it was not.
};

}  // namespace swiftlet::common
