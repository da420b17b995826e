#include "simulation/fault_config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::simulation {
namespace {

/// In the order of FaultKind.
const std::vector<std::string> kKinds{"silent",    "nan",       "repeat",     "late",        "stuck",    "bias",
                                      "mirror",    "blocked",   "black",      "white",       "flipped",  "other_size",
                                      "exchanged", "one_sided", "clock_jump", "clock_drift", "lost_cell"};

using common::Message;

/// A fault that ends before it begins never happens, and its trial passes without having tried anything.
common::Validation timeProblems(const FaultConfig& fault) {
  common::Validation validation;
  if (isOfBattery(fault.kind))
    return validation
        .require(fault.to_s == 0.0, "to_s", Message("fault.lost-for-good", "is given, but a lost cell stays lost"))
        .require(fault.lasts_s == 0.0, "lasts_s",
                 Message("fault.lost-for-good", "is given, but a lost cell stays lost"));
  if (fault.isTriggered())
    return validation
        .require(fault.lasts_s > 0.0, "lasts_s",
                 Message("fault.no-duration", "is missing: a fault with place or phase needs it"))
        .require(fault.to_s == 0.0, "to_s",
                 Message("fault.end-of-place", "is for a fault without place or phase; give lasts_s instead"));
  return validation.require(fault.to_s != 0.0, "to_s", Message("fault.no-end", "is missing: when does the fault end?"))
      .require(fault.to_s == 0.0 || fault.to_s > fault.from_s, "to_s",
               Message("fault.ends-early", "{} is not after from_s, which is {}", fault.to_s, fault.from_s))
      .require(fault.lasts_s == 0.0, "lasts_s",
               Message("fault.duration-of-time", "is for a fault with place or phase; give to_s instead"));
}

}  // namespace

bool isOfPictures(FaultKind kind) {
  return kind == FaultKind::kBlack || kind == FaultKind::kWhite || kind == FaultKind::kFlipped ||
         kind == FaultKind::kOtherSize || kind == FaultKind::kExchanged || kind == FaultKind::kOneSided;
}

bool isOfBattery(FaultKind kind) { return kind == FaultKind::kLostCell; }

void FaultConfig::describe(common::config::Fields& fields) {
  fields.choice("sensor", sensor, {"imu", "laser", "battery", "pilot", "camera", "rgbd", "vertical_laser"},
                "Which sensor fails.");
  fields.choice(
      "kind", kind, kKinds,
      "What goes wrong; stuck and bias are for the imu, mirror and blocked for the laser, black, white, flipped "
      "and other_size for camera and rgbd, exchanged and one_sided for a rgbd that is a stereo camera, lost_cell for "
      "the "
      "battery.");
  fields("from_s", from_s, {0, 1e6}, "Time at which the fault begins; with place or phase, before which it does not.");
  fields("to_s", to_s, {0, 1e6},
         "Time at which the fault ends; after from_s. Not with place or phase, and not for kind lost_cell, which never "
         "ends.");
  fields("late_s", late_s, {0, 100}, "Delay of measurements, for kind late.");
  fields("place_world_m", place_world_m, {-1e4, 1e4},
         "Place x, y in the world: the fault begins when the vehicle first comes there; empty for anywhere.");
  fields("within_m", within_m, {0.01, 1000}, "Horizontal distance from the place at which the fault begins.");
  fields("phase", phase,
         "The fault begins when the flight's state, the mission's phase or reason, or a running behaviour first begins "
         "with this "
         "text: `taking off`, `explore`, `GoHome`; empty for any.");
  fields("lasts_s", lasts_s, {0, 1e6},
         "Duration of a fault that begins at a place or in a phase; not for kind lost_cell.");
  fields("gyro_bias_deg_s", gyro_bias_deg_s, {-500, 500}, "For kind bias: error of the rate about each axis.");
  fields("accel_bias_m_s2", accel_bias_m_s2, {-50, 50}, "For kind bias: error of the specific force on each axis.");
  fields("from_deg", from_deg, {-180, 180}, "For kind blocked: angle of the first blocked beam, to the left of ahead.");
  fields("to_deg", to_deg, {-180, 180}, "For kind blocked: angle of the last blocked beam; at least from_deg.");
  fields("jump_s", jump_s, {-10, 10},
         "For kind clock_jump: what the clock of the measurements' stamps is ahead while the fault lasts; not 0.");
  fields("drift_s_s", drift_s_s, {-0.5, 0.5},
         "For kind clock_drift: seconds that the clock of the stamps gains in each second of the fault; not 0.");
}

std::vector<common::Problem> FaultConfig::validate() const {
  const bool of_imu = kind == FaultKind::kStuck || kind == FaultKind::kBias;
  const bool of_laser = kind == FaultKind::kMirror || kind == FaultKind::kBlocked;
  const bool has_pictures = sensor == Sensor::kCamera || sensor == Sensor::kRgbd;
  common::Validation validation = timeProblems(*this);
  return validation.atMost("from_deg", from_deg, "to_deg", to_deg)
      .require(place_world_m.empty() || place_world_m.size() == 2, "place_world_m",
               Message("fault.no-point", "is not one point x, y"))
      .require(!of_imu || sensor == Sensor::kImu, "kind",
               Message("fault.of-imu", "stuck and bias are faults of the imu alone"))
      .require(!of_laser || sensor == Sensor::kLaser, "kind",
               Message("fault.of-laser", "mirror and blocked are faults of the laser alone"))
      .require(!isOfPictures(kind) || has_pictures, "kind",
               Message("fault.of-pictures", "faults of pictures are faults of camera and rgbd alone"))
      .require(!isOfBattery(kind) || sensor == Sensor::kBattery, "kind",
               Message("fault.of-battery", "lost_cell is a fault of the battery alone"))
      .require(kind != FaultKind::kClockJump || jump_s != 0.0, "jump_s",
               Message("fault.no-jump", "is missing: how far does the clock jump?"))
      .require(kind != FaultKind::kClockDrift || drift_s_s != 0.0, "drift_s_s",
               Message("fault.no-drift", "is missing: how fast does the clock drift?"))
      .problems();
}

std::string nameOf(const FaultConfig& fault) {
  std::string when = fault.phase;
  if (when.empty()) when = fault.place_world_m.empty() ? fmt::format("{:g}s", fault.from_s) : "place";
  std::replace(when.begin(), when.end(), ' ', '_');
  const auto kind = static_cast<std::size_t>(fault.kind);
  const double off_m_s2 = fault.kind == FaultKind::kBias ? fault.accel_bias_m_s2 : 0.0;
  return fmt::format("{}-{}{}-{}", toString(fault.sensor), kKinds.at(kind),
                     off_m_s2 != 0.0 ? fmt::format("{:+g}m_s2", off_m_s2) : "", when);
}

}  // namespace swiftlet::simulation
