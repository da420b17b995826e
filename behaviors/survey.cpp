#include "behaviors/survey.hpp"

#include <fmt/format.h>

#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

using tree::PortType;

tree::NodeManifest Survey::manifest() {
  return {.id = "Survey",
          .kind = tree::NodeKind::kAction,
          .ports = {polygonPort("that is surveyed"),
                    {.name = "spacing_m",
                     .type = PortType::kDouble,
                     .minimum = 0.2,
                     .maximum = 20.0,
                     .description = "Greatest distance between two lanes. Not given: from the strip of floor that the "
                                    "camera sees, with an overlap; 1 m without a camera."},
                    {.name = "height_m",
                     .type = PortType::kDouble,
                     .description = "Height above the take-off floor. Not given: the present height."},
                    clearancePort(),
                    modePort()},
          .description = "Flies over an area in lanes.",
          .details =
              "The lanes are along its longest edge, and the strips of floor that the camera sees overlap by 40 %. A "
              "place of a lane that is not free is moved aside by up to half a lane, or left out.",
          .ends = "SUCCESS after the last lane; FAILURE when no place is free"};
}

std::optional<tree::Message> surveyProblem(const common::Polygon& area) {
  constexpr double kFarthest_m = 300.0;
  const double across_m = (area.max_map_m() - area.min_map_m()).norm();
  if (across_m <= kFarthest_m) return std::nullopt;
  return tree::Message("mission.survey-large",
                       "is {:.0f} m from corner to corner, more than the {:.0f} m that are surveyed at once", across_m,
                       kFarthest_m);
}

Survey::Survey(const tree::NodeSetup& setup)
    : IntentLeaf(setup),
      polygon_(setup, "polygon"),
      spacing_m_(setup, "spacing_m"),
      height_m_(setup, "height_m"),
      clearance_m_(setup, "clearance_m"),
      mode_(setup, "mode") {}

IntentLeaf::IntentOrProblem Survey::makeIntent(const FlightTick& tick) {
  const auto points = polygon_.get();
  const auto spacing_m = spacing_m_.get(), height_m = height_m_.get(), clearance_m = clearance_m_.get();
  const auto mode = modeOr(mode_, tick.mode);
  if (!points) return tl::unexpected(polygon_.problem());
  if (spacing_m_.given() && !spacing_m) return tl::unexpected(spacing_m_.problem());
  if (height_m_.given() && !height_m) return tl::unexpected(height_m_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  if (!mode) return tl::unexpected(mode_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  const common::Polygon area = places->inMap(*points);
  if (const auto problem = problemOf(area)) return tl::unexpected(problem->text());
  if (const auto problem = surveyProblem(area)) return tl::unexpected(problem->text());
  common::Goal at_height{.place_map_m = area.corners_map_m.front(), .height_m = height_m};
  const auto verdict = common::judgeGoal(at_height, tick.flight.goal_limits, nullptr);
  if (!verdict) return tl::unexpected(verdict.error().text);
  return common::SurveyIntent{area, spacing_m, height_m, *clearance_m, *mode};
}

}  // namespace swiftlet::behaviors
