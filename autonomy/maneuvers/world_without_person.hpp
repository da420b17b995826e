// The world in which a path behind a person is planned: the world without that person. A person who
// stands is mapped, and the map takes seconds to forget it.
#pragma once

#include "autonomy/maneuvers/maneuver_input.hpp"
#include "autonomy/maneuvers/person_watch.hpp"

namespace swiftlet::autonomy {

struct PersonInMap {
  double body_m = 0.3;     ///< No other obstacle is this near to the middle of a person.
  double within_m = 0.45;  ///< What the map shows this near to a person may be the person.
};

/// Occupied cells within `body_m` of the trail, `within_m` of the person, and those within `within_m` of the trail that
/// the newest scan sees past, are free; the discs of the person are left out. Everything else is as given. The person
/// is known.
ManeuverInput worldWithoutPerson(const ManeuverInput& input, const PersonWatch& person, const PersonInMap& extent);

}  // namespace swiftlet::autonomy
