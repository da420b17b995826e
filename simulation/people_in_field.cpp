#include "simulation/people_in_field.hpp"

#include <cmath>

namespace swiftlet::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

PeopleInField::PeopleInField(const common::LaserConfig& laser, const RayCaster& rays) : laser_(laser), rays_(rays) {}

void PeopleInField::look(common::Time now, const common::Pose3& T_world_body, std::span<const Walker> walkers) {
  since_.resize(walkers.size());
  const common::Pose3 T_world_laser = T_world_body * laser_.mount.pose();
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const std::optional<Actor>& person = walkers[i].actor();
    if (!person)
      since_[i].reset();
    else if (!since_[i] && sees(T_world_laser, *person))
      since_[i] = now;
  }
}

/// Looks at the middle of the person and, as one who comes round a corner is seen from the side, near both edges.
bool PeopleInField::sees(const common::Pose3& T_world_laser, const Actor& person) const {
  constexpr double kEdge = 0.8;  // Of the radius: nearer to the edge a beam grazes the person.
  const Vector3d& from = T_world_laser.position_m;
  if (from.z() < person.bottom_m || from.z() > person.top_m) return false;
  const Vector2d ahead = (person.position_world_m - from.head<2>()).normalized();
  for (const double aside : {0.0, -kEdge, kEdge}) {
    const Vector2d point = person.position_world_m + aside * person.radius_m * Vector2d(-ahead.y(), ahead.x());
    const Vector3d to(point.x() - from.x(), point.y() - from.y(), 0.0);
    const Vector3d to_laser = T_world_laser.rotation.conjugate() * to;
    const double angle_rad = std::atan2(to_laser.y(), to_laser.x());
    const int beam = static_cast<int>(std::lround((angle_rad - laser_.angleMin_rad()) / laser_.angleIncrement_rad()));
    if (beam < 0 || beam >= laser_.beams || laser_.isMirrorBeam(beam)) continue;
    if (to.norm() <= laser_.range_max_m && !rays_.cast(from, to.normalized(), to.norm())) return true;
  }
  return false;
}

}  // namespace swiftlet::simulation
