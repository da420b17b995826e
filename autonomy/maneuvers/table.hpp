// Which maneuver carries out which intent.
#pragma once

#include <memory>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

/// Makes the maneuver of an intent.
std::unique_ptr<Maneuver> makeManeuver(const common::IntentKind& kind, const ManeuverSetup& setup);

}  // namespace swiftlet::autonomy
