// Which maneuver carries out which intent: a line for each. An intent that is missing does not compile.
#pragma once

#include <memory>

#include "autonomy/maneuvers/maneuver.hpp"

namespace swiftlet::autonomy {

// Each stands in the source of its maneuver.
std::unique_ptr<Maneuver> maneuverFor(const common::HoldIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::AvoidIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::EmergencyLandIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::TakeOffIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::LandIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::ExploreIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::GoToIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::RetraceIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::SurveyIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::InspectIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::FollowIntent& intent, const ManeuverSetup& setup);
std::unique_ptr<Maneuver> maneuverFor(const common::FlyThroughIntent& intent, const ManeuverSetup& setup);

/// Makes the maneuver of an intent.
std::unique_ptr<Maneuver> makeManeuver(const common::IntentKind& kind, const ManeuverSetup& setup);

}  // namespace swiftlet::autonomy
