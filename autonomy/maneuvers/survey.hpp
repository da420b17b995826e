// Survey: flies over an area in lanes along its longest edge, so that the sensor sees all of it. Places that are not
// free are moved aside by up to half a lane, or left out.
#pragma once

#include "autonomy/maneuvers/tour.hpp"

namespace swiftlet::autonomy {

class Survey final : public Tour {
 public:
  Survey(const common::SurveyIntent& intent, const ManeuverSetup& setup);

 private:
  std::vector<Eigen::Vector2d> lay(const planning::CostMap& map, const ManeuverInput& input) override;
  std::optional<Eigen::Vector2d> standFor(const planning::CostMap& map,
                                          const Eigen::Vector2d& place_map_m) const override;
  std::string doing(const ManeuverInput&) const override { return "surveying"; }

  common::SurveyIntent intent_;
  double spacing_m_;
};

}  // namespace swiftlet::autonomy
