#include "simulation/survey.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::simulation {

using common::kRadPerDeg;
using common::Pose2;
using common::Time;

void SurveyConfig::describe(common::config::Fields& fields) {
  fields(
      "path_world_m", path_world_m, {-1e4, 1e4},
      "Points x, y, x, y of the path that the robot drives, turning on the spot at each; empty when no map is made.");
  fields("world", world, "World of the drive, such as another day's of the same place; empty: that of the flights.");
  fields("laser", laser, "Laser of the robot: a file of config/sensors, without .yaml.");
  fields("laser_height_world_m", laser_height_world_m, {-100, 100},
         "Height of the robot's laser beams in the world's frame.");
  fields("speed_m_s", speed_m_s, {0.05, 5}, "Speed between the points.");
  fields("turn_deg_s", turn_deg_s, {1, 360}, "Speed of the turns on the spot.");
  fields("seed", seed, {0, 1'000'000'000}, "Seed of the drive's noise; the flights' seed changes nothing here.");
}

std::vector<common::Problem> SurveyConfig::validate() const {
  const bool pairs = path_world_m.size() % 2 == 0 && path_world_m.size() != 2;
  return common::Validation()
      .require(pairs, "path_world_m", common::Message("survey.no-path", "is not a list of two or more points x, y"))
      .problems();
}

SurveyDrive::SurveyDrive(const SurveyConfig& config, const common::LaserConfig& laser, const RayCaster& rays)
    : config_(config), laser_(laser), rays_(rays), scanner_(laser, config.seed) {
  const std::vector<double>& path = config.path_world_m;
  SWIFTLET_CHECK(path.size() >= 4 && path.size() % 2 == 0, path.size());
  Pose2 at{path[0], path[1], std::atan2(path[3] - path[1], path[2] - path[0])};
  for (std::size_t i = 2; i < path.size(); i += 2) {
    const Eigen::Vector2d leg = Eigen::Vector2d(path[i], path[i + 1]) - at.position_m();
    if (leg.norm() < 1e-6) continue;
    const double turn_rad = common::wrapAngle(std::atan2(leg.y(), leg.x()) - at.yaw_rad);
    addLeg({at, 0.0, turn_rad}, std::abs(turn_rad) / (config.turn_deg_s * kRadPerDeg));
    at.yaw_rad = common::wrapAngle(at.yaw_rad + turn_rad);
    addLeg({at, leg.norm(), 0.0}, leg.norm() / config.speed_m_s);
    at = {path[i], path[i + 1], at.yaw_rad};
  }
}

void SurveyDrive::addLeg(const Leg& leg, double duration_s) {
  Leg added = leg;
  added.begin_s = SurveyDrive::duration_s();
  added.end_s = added.begin_s + duration_s;
  if (duration_s > 0.0) legs_.push_back(added);
}

std::optional<SurveyScan> SurveyDrive::next() {
  const double start_s = static_cast<double>(frame_) / laser_.rate_hz;
  const double sweep_s = std::max(scanner_.sweep().seconds(), 1e-3);
  if (start_s + sweep_s > duration_s()) return std::nullopt;
  const Time start = Time::fromSeconds(start_s), end = Time::fromSeconds(start_s + sweep_s);
  SurveyScan taken;
  taken.T_world_body = poseAt(start_s);
  taken.scan =
      scanner_.scan(frame_++, start, {{start, bodyAt(start_s), {}}, {end, bodyAt(start_s + sweep_s), {}}}, rays_);
  taken.scan.stamps.arrived = end;
  return taken;
}

Pose2 SurveyDrive::poseAt(double time_s) const {
  const auto after = std::find_if(legs_.begin(), legs_.end(), [&](const Leg& leg) { return time_s < leg.end_s; });
  const Leg& leg = after == legs_.end() ? legs_.back() : *after;
  const double share = std::clamp((time_s - leg.begin_s) / (leg.end_s - leg.begin_s), 0.0, 1.0);
  return leg.from * Pose2{share * leg.distance_m, 0.0, share * leg.turn_rad};
}

common::Pose3 SurveyDrive::bodyAt(double time_s) const {
  return common::lifted(poseAt(time_s), config_.laser_height_world_m);
}

}  // namespace swiftlet::simulation
