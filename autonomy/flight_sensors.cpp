#include "autonomy/flight_sensors.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

/// Cosine of the greatest angle at which beams still look more down than aside, or more aside than up.
const double kMostlyCos = std::numbers::sqrt2 / 2.0;

/// Of the angle between the deflected beams and straight down.
double downCos(const common::LaserConfig& laser) {
  return (laser.mirror_mount.pose().rotation * Eigen::Vector3d::UnitZ()).z();
}

void tell(std::vector<common::Problem>& problems, std::string message, std::string hint) {
  problems.push_back({{}, "laser", std::move(message), std::move(hint)});
}

/// A flight higher than the beams down reach would not be seen to be too high.
void checkHeight(const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
                 std::vector<common::Problem>& problems) {
  if (laser.mirror_beams == 0)
    return tell(
        problems,
        fmt::format("nothing measures the height: no beam of {} looks down, its mirror_beams are 0", laser.name),
        "fly with a laser that has a mirror, as `utm_30lx`, or describe that of this one by mirror_first_beam, "
        "mirror_beams and mirror_mount in its sheet");
  if (downCos(laser) < kMostlyCos)
    return tell(problems,
                fmt::format("nothing measures the height: the mirror_mount of {} turns its beams away from the floor",
                            laser.name),
                "they point along the -z of that mount, which is down without roll and pitch");
  const double reach_m = measuredHeight_m(laser);
  if (reach_m < vehicle.max_height_m)
    tell(problems,
         fmt::format("the beams down of {} reach {:.2f} m (range_max_m), and {} may fly {:.2f} m high", laser.name,
                     reach_m, vehicle.name, vehicle.max_height_m),
         fmt::format("set `max_height_m: {:.1f}` in the vehicle's sheet, or name a laser that reaches farther",
                     std::floor(10.0 * reach_m) / 10.0));
}

void checkPosition(const common::LaserConfig& laser, int least_beams, std::vector<common::Problem>& problems) {
  const double level_cos = std::abs((laser.mount.pose().rotation * Eigen::Vector3d::UnitZ()).z());
  if (level_cos < kMostlyCos)
    tell(problems,
         fmt::format("nothing measures the position: the mount of {} turns its scan plane upright", laser.name),
         "the first laser looks around; an upright one is named by vertical_laser");
  const int around = laser.beams - laser.mirror_beams;
  if (around < least_beams)
    tell(problems,
         fmt::format("nothing measures the position: {} of the beams of {} look around, and a match takes {}", around,
                     laser.name, least_beams),
         "lower min_points of the matcher, below autonomy.estimator.odometry.matcher, or name a laser with more beams");
}

}  // namespace

double measuredHeight_m(const common::LaserConfig& laser) {
  return laser.mirror_beams == 0 ? 0.0 : downCos(laser) * laser.range_max_m - laser.mirror_mount.z_m;
}

std::vector<common::Problem> problemsOfSensors(const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
                                               int least_beams) {
  std::vector<common::Problem> problems;
  checkHeight(laser, vehicle, problems);
  checkPosition(laser, least_beams, problems);
  return problems;
}

}  // namespace swiftlet::autonomy
