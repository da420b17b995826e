// What a behaviour requests of the flight beside its intent: something done at once, or with the next camera frame.
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

/// Write the present map into the folder of the run.
struct SaveMapRequest {
  std::string name;
};
/// Write the next picture of the RGB-D camera into the folder of the run, with the pose of the camera.
struct PhotographRequest {
  std::string name;
};

/// From now on that map is the given one. The maps that a mission may ask for are read before the flight.
struct LoadMapRequest {
  std::string file;  ///< As the mission names it.
};
/// Forget the pose in the given map and search for it again.
struct RelocalizeRequest {};

using MissionRequestKind =
    std::variant<KeepOutRequest, SaveMapRequest, PhotographRequest, LoadMapRequest, RelocalizeRequest>;

struct MissionRequest {
  std::uint64_t id = 0;  ///< The ids of one mission rise from 1.
  MissionRequestKind kind;
};

struct MissionAnswer {
  std::uint64_t id = 0;  ///< Id of the request that this answers.
  bool done = false;
  std::string reason;  ///< For people: what was done, or why it was not.
};

}  // namespace swiftlet::common
