#include "autonomy/maneuvers/table.hpp"

#include <variant>

#include "autonomy/maneuvers/avoid.hpp"
#include "autonomy/maneuvers/emergency_land.hpp"
#include "autonomy/maneuvers/explore.hpp"
#include "autonomy/maneuvers/follow.hpp"
#include "autonomy/maneuvers/go_to.hpp"
#include "autonomy/maneuvers/hold.hpp"
#include "autonomy/maneuvers/inspect.hpp"
#include "autonomy/maneuvers/land.hpp"
#include "autonomy/maneuvers/retrace.hpp"
#include "autonomy/maneuvers/survey.hpp"
#include "autonomy/maneuvers/take_off.hpp"

namespace swiftlet::autonomy {
namespace {

/// The table has one line for each intent. An intent that is missing does not compile.
struct Made {
  using Pointer = std::unique_ptr<Maneuver>;
  const ManeuverSetup& setup;

  Pointer operator()(const common::HoldIntent& intent) const { return std::make_unique<Hold>(intent, setup); }
  Pointer operator()(const common::TakeOffIntent& intent) const { return std::make_unique<TakeOff>(intent, setup); }
  Pointer operator()(const common::LandIntent& intent) const { return std::make_unique<Land>(intent, setup); }
  Pointer operator()(const common::ExploreIntent& intent) const { return std::make_unique<Explore>(intent, setup); }
  Pointer operator()(const common::GoToIntent& intent) const { return std::make_unique<GoTo>(intent, setup); }
  Pointer operator()(const common::AvoidIntent& intent) const { return std::make_unique<Avoid>(intent, setup); }
  Pointer operator()(const common::RetraceIntent& intent) const { return std::make_unique<Retrace>(intent, setup); }
  Pointer operator()(const common::SurveyIntent& intent) const { return std::make_unique<Survey>(intent, setup); }
  Pointer operator()(const common::InspectIntent& intent) const { return std::make_unique<Inspect>(intent, setup); }
  Pointer operator()(const common::FollowIntent& intent) const { return std::make_unique<Follow>(intent, setup); }
  Pointer operator()(const common::EmergencyLandIntent& intent) const {
    return std::make_unique<EmergencyLand>(intent, setup);
  }
};

}  // namespace

std::unique_ptr<Maneuver> makeManeuver(const common::IntentKind& kind, const ManeuverSetup& setup) {
  return std::visit(Made{setup}, kind);
}

}  // namespace swiftlet::autonomy
