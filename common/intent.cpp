#include "common/intent.hpp"

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

struct Describe {
  const PlaceNames& names;

  template <typename Kind>
  std::string operator()(const Kind&) const {
    return Kind::kText;
  }
  std::string operator()(const TakeOffIntent& i) const { return fmt::format("take off to {:.2f} m", i.height_m); }
  std::string operator()(const GoToIntent& i) const { return "go to " + placeOf(i, names); }
  std::string operator()(const SurveyIntent& i) const { return "survey an area with " + toString(i.area, names); }
  std::string operator()(const InspectIntent& i) const { return "inspect " + names.of(i.point_map_m); }
  std::string operator()(const FollowIntent& i) const {
    return i.until_near ? "return to the person" : "follow a person";
  }
  std::string operator()(const FlyThroughIntent& i) const {
    return fmt::format("fly through {} {}", i.what, i.object_id);
  }
};

}  // namespace

std::string placeOf(const GoToIntent& goal, const PlaceNames& names) {
  return goal.goal_given_m ? nameOfGivenPlace(*goal.goal_given_m) : names.of(goal.goal_map_m);
}

std::string toString(const Intent& intent, const PlaceNames& names) { return std::visit(Describe{names}, intent.kind); }

}  // namespace swiftlet::common
