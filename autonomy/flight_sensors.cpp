#include "autonomy/flight_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Message;

/// Cosine of the greatest angle at which beams still look more down than aside, or more aside than up.
const double kMostlyCos = std::numbers::sqrt2 / 2.0;

/// Walls must be seen as far as across a small room; to 4 m a tilt of 14 deg does, in which explorations have gone
/// well.
constexpr double kLeastSight_m = 4.0;

/// With a narrower view, a vehicle that turns in a room loses sight of what it knows before what it sees next has
/// joined the map: of explorations at 57 deg one of two lost the position, at 80 deg one of four, at 87 and 90 deg
/// none.
constexpr double kLeastView_deg = 85.0;

/// Of the angle between the deflected beams and straight down.
double downCos(const common::LaserConfig& laser) {
  return (laser.mirror_mount.pose().rotation * Eigen::Vector3d::UnitZ()).z();
}

class SensorCheck {
 public:
  SensorCheck(const common::LaserConfig& laser, const common::VehicleConfig& vehicle, const ScanNeeds& needs)
      : laser_(laser), vehicle_(vehicle), needs_(needs) {}

  std::vector<common::Problem> find() {
    checkHeight();
    checkPosition();
    checkTilt();
    checkRate();
    return std::move(problems_);
  }

 private:
  void add(Message message, std::string hint) {
    problems_.push_back({{}, "laser", std::move(message), std::move(hint)});
  }

  /// A vehicle that stands has its sensors above the floor. "below the floor on which cobra stands" if it has not.
  std::string below(const common::MountConfig& mount) const {
    const double height_m = 0.5 * vehicle_.hull_height_m + mount.z_m;
    return height_m > 0.0 ? ""
                          : fmt::format(
                                "z_m {} is {:.2f} m below the floor on which {} stands, half of its "
                                "hull_height_m below the origin",
                                mount.z_m, -height_m, vehicle_.name);
  }

  void checkHeight();
  void checkReach();
  void checkPosition();
  void checkTilt();
  void checkRate();

  const common::LaserConfig& laser_;
  const common::VehicleConfig& vehicle_;
  const ScanNeeds& needs_;
  std::vector<common::Problem> problems_;
};

void SensorCheck::checkHeight() {
  if (laser_.mirror_beams == 0)
    return add(Message("sensors.no-mirror",
                       "nothing measures the height: no beam of {} looks down, its mirror_beams are 0", laser_.name),
               "fly with a laser that has a mirror, as `utm_30lx`, or describe that of this one by mirror_first_beam, "
               "mirror_beams and mirror_mount in its sheet");
  if (downCos(laser_) < kMostlyCos)
    return add(
        Message("sensors.mirror-turned-away",
                "nothing measures the height: the mirror_mount of {} turns its beams away from the floor", laser_.name),
        "they point along the -z of that mount, which is down without roll and pitch");
  // Rarely fewer than half a beam: in every other scan the height is measured.
  if (laser_.mirror_beams * (1.0 - laser_.dropout_rate) < 0.5)
    return add(Message("sensors.few-beams-down",
                       "nothing measures the height: of the {} beams down of {} hardly one returns, its "
                       "dropout_rate is {}",
                       laser_.mirror_beams, laser_.name, laser_.dropout_rate),
               "it is the share of beams without a return: 0.002 is usual");
  if (const std::string why = below(laser_.mirror_mount); !why.empty())
    return add(Message("sensors.mirror-below-floor", "nothing measures the height: the mirror_mount of {}: {}",
                       laser_.name, why),
               "z_m counts upward");
  checkReach();
}

/// A flight higher or lower than the beams down measure would not be seen to be too high or too low.
void SensorCheck::checkReach() {
  const double reach_m = measuredHeight_m(laser_), least_m = leastMeasuredHeight_m(laser_);
  if (reach_m < vehicle_.max_height_m)
    add(Message("sensors.flies-too-high",
                "the beams down of {} reach {:.2f} m (range_max_m), and {} may fly {:.2f} m high", laser_.name, reach_m,
                vehicle_.name, vehicle_.max_height_m),
        fmt::format("set `max_height_m: {:.1f}` in the vehicle's sheet, or name a laser that reaches farther",
                    std::floor(10.0 * reach_m) / 10.0));
  if (least_m > vehicle_.max_height_m)
    add(Message("sensors.flies-too-low",
                "the beams down of {} measure no height below {:.2f} m (range_min_m), and {} may fly {:.2f} m high",
                laser_.name, least_m, vehicle_.name, vehicle_.max_height_m),
        "range_min_m is the shortest range that the laser measures: 0.1 is usual");
}

void SensorCheck::checkPosition() {
  const int around = laser_.beams - laser_.mirror_beams;
  if (around < needs_.least_beams)
    return add(Message("sensors.too-few-beams",
                       "nothing measures the position: {} of the beams of {} look around, and a match takes {}", around,
                       laser_.name, needs_.least_beams),
               "name a laser with more beams");
  const double returning = around * (1.0 - laser_.dropout_rate);
  if (returning < needs_.least_beams)
    return add(Message("sensors.too-few-returns",
                       "nothing measures the position: {:.0f} of the beams of {} return, its dropout_rate is {}, "
                       "and a match takes {}",
                       returning, laser_.name, laser_.dropout_rate, needs_.least_beams),
               "it is the share of beams without a return: 0.002 is usual");
  if (const double view_deg = laser_.field_of_view_deg * around / laser_.beams; view_deg < kLeastView_deg)
    add(Message("sensors.view-too-narrow",
                "nothing measures the position: the beams of {} look around over {:.0f} deg (field_of_view_deg), "
                "and turns in a room need {:.0f}",
                laser_.name, view_deg, kLeastView_deg),
        "name a laser with a wider view");
  if (const std::string why = below(laser_.mount); !why.empty())
    add(Message("sensors.laser-below-floor", "nothing measures the position: the mount of {}: {}", laser_.name, why),
        "z_m counts upward");
}

/// A wall counts as floor or ceiling where a slanted beam hits it far below or above the laser. The rest is
/// seen up to a distance that shrinks with the slant.
void SensorCheck::checkTilt() {
  const double level_cos = std::abs((laser_.mount.pose().rotation * Eigen::Vector3d::UnitZ()).z());
  if (level_cos < kMostlyCos)
    return add(Message("sensors.plane-upright",
                       "nothing measures the position: the mount of {} turns its scan plane upright", laser_.name),
               "the first laser looks around; an upright one is named by vertical_laser");
  const double tilt_rad = std::acos(std::min(level_cos, 1.0));
  const double sight_m = needs_.max_rise_m / std::max(std::tan(tilt_rad), 1e-6);
  if (sight_m >= kLeastSight_m) return;
  add(Message("sensors.plane-tilted",
              "the mount of {} tilts its scan plane by {:.0f} deg: beyond {:.1f} m its beams are {} m above or "
              "below the laser, where walls count as floor or ceiling, and the position is lost",
              laser_.name, tilt_rad / common::kRadPerDeg, sight_m, needs_.max_rise_m),
      fmt::format("mount it level: roll_deg and pitch_deg carry a flight up to {:.0f} deg",
                  std::floor(std::atan(needs_.max_rise_m / kLeastSight_m) / common::kRadPerDeg)));
}

/// A scan is of the middle of its sweep, arrives at the end of it, and is used until the next one arrives.
void SensorCheck::checkRate() {
  const double period_s = 1.0 / laser_.rate_hz;
  const double silence_s = period_s + needs_.delay_s, age_s = silence_s + 0.5 * laser_.sweep_s;
  if (silence_s <= needs_.longest_silence_s && age_s <= needs_.longest_age_s) return;
  // A sweep lasts a period at most.
  const double room_s =
      std::min(needs_.longest_silence_s - needs_.delay_s, (needs_.longest_age_s - needs_.delay_s) / 1.5);
  const bool silent = silence_s > needs_.longest_silence_s;
  add(Message("sensors.too-seldom", "{} measures too seldom: its scans come every {:.2f} s (rate_hz: {}), and {}",
              laser_.name, period_s, laser_.rate_hz,
              silent ? fmt::format("after {} s without one the vehicle holds", needs_.longest_silence_s)
                     : fmt::format("a position older than {} s is lost "
                                   "(autonomy.estimator.fusion.horizontal_timeout_s)",
                                   needs_.longest_age_s)),
      fmt::format("name a laser of at least {:.1f} scans a second", std::ceil(10.0 / std::max(room_s, 1e-3)) / 10.0));
}

}  // namespace

double measuredHeight_m(const common::LaserConfig& laser) {
  return laser.mirror_beams == 0 ? 0.0 : downCos(laser) * laser.range_max_m - laser.mirror_mount.z_m;
}

double leastMeasuredHeight_m(const common::LaserConfig& laser) {
  constexpr double kSway_m = 0.1;  // Of a hover, and of what lies on the floor.
  return laser.range_min_m - laser.mirror_mount.z_m + kSway_m;
}

std::vector<common::Problem> problemsOfSensors(const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
                                               const ScanNeeds& needs) {
  return SensorCheck(laser, vehicle, needs).find();
}

}  // namespace swiftlet::autonomy
