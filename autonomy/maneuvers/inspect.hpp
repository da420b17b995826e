// Inspect: orbits a point with the nose, and so the camera, on it. First it flies to the nearest place of the circle
// and turns to the point. Parts of the circle that are not free are left out.
#pragma once

#include <optional>

#include "autonomy/maneuvers/tour.hpp"

namespace swiftlet::autonomy {

class Inspect final : public Tour {
 public:
  Inspect(const common::InspectIntent& intent, const ManeuverSetup& setup);

 private:
  void watch(const ManeuverInput& input) override;
  common::Pose3 T_body_camera(const ManeuverInput& input) const;
  double headingToSee_rad(const ManeuverInput& input) const;
  std::vector<Eigen::Vector2d> lay(const planning::CostMap& map, const ManeuverInput& input) override;
  bool ready(const ManeuverInput& input) override;
  bool inspecting(const ManeuverInput& input) const override;
  void chooseHeight(const ManeuverInput& input);
  bool isOnCircle(const ManeuverInput& input) const;
  std::string doing(const ManeuverInput& input) const override;

  common::InspectIntent intent_;
  std::optional<common::Time> faces_since_;  ///< None while it looks elsewhere.
  bool faced_ = false;                       ///< It has turned to the point since it began, or was interrupted.
};

}  // namespace swiftlet::autonomy
