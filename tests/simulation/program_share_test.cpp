// A pilot's sticks and the program's setpoints together: the program moves each stick by its share and no more, and a
// program that has failed leaves the pilot flying.
#include <limits>

#include <gtest/gtest.h>

#include "simulation/autopilot.hpp"

namespace swiftlet::simulation {
namespace {

using common::Setpoint;
using common::Time;

constexpr double kShare = 0.2;
constexpr double kSimulatorStep_s = 0.002;

struct Pair {
  Pair() : mixing({}, {}, config(kShare)), alone({}, {}, config(0.0)) {}
  static AutopilotConfig config(double share) {
    AutopilotConfig config;
    config.program_share = share;
    return config;
  }
  /// The throttles of both, for one tick with these sticks.
  void expectAlike(const Setpoint& sticks_of_mixing, const Setpoint& sticks_of_alone, Time now, const char* what) {
    mixing.fly(sticks_of_mixing, now);
    alone.fly(sticks_of_alone, now);
    EXPECT_EQ(mixing.tick(now, {}, kSimulatorStep_s), alone.tick(now, {}, kSimulatorStep_s)) << what;
  }
  Autopilot mixing, alone;
};

const double kMaxTilt_rad = common::VehicleConfig{}.max_tilt_deg * std::numbers::pi / 180.0;
const Setpoint kSticks{Time(), true, 0.0, 0.5 * kMaxTilt_rad, 0.4, 0.55};

TEST(ProgramShare, MovesEachStickByItsShareAndNoMore) {
  Pair pair;
  pair.mixing.receive({Time(), true, kMaxTilt_rad, -kMaxTilt_rad, -2.5, 1.0}, Time());
  Setpoint moved = kSticks;
  moved.roll_rad = 0.2 * kMaxTilt_rad;
  moved.pitch_rad = 0.3 * kMaxTilt_rad;
  moved.yaw_rate_rad_s = 0.4 - 0.2 * AutopilotConfig{}.max_yaw_rate_rad_s;
  moved.thrust = 0.75;
  pair.expectAlike(kSticks, moved, Time(), "at the bounds");
}

TEST(ProgramShare, IsTheProgramsWishWhereThatIsNearTheSticks) {
  Pair pair;
  Setpoint wish = kSticks;
  wish.pitch_rad = 0.4 * kMaxTilt_rad;
  wish.thrust = 0.6;
  pair.mixing.receive(wish, Time());
  pair.expectAlike(kSticks, wish, Time(), "within the bounds");
}

TEST(ProgramShare, AFailedProgramLeavesThePilotFlying) {
  Pair pair;
  Setpoint other{Time(), true, kMaxTilt_rad, -kMaxTilt_rad, 0.0, 1.0};
  pair.mixing.receive(other, Time());
  pair.expectAlike(kSticks, kSticks, Time::fromSeconds(1.0), "it has said nothing for a second");
  other.roll_rad = std::numeric_limits<double>::quiet_NaN();
  pair.mixing.receive(other, Time::fromSeconds(1.1));
  pair.expectAlike(kSticks, kSticks, Time::fromSeconds(1.1), "not a number");
  other = {Time(), false, 0.0, 0.0, 0.0, 0.0};
  pair.mixing.receive(other, Time::fromSeconds(1.2));
  pair.expectAlike(kSticks, kSticks, Time::fromSeconds(1.2), "its motors are off");
}

TEST(ProgramShare, ThePilotSwitchesTheMotorsOff) {
  Pair pair;
  pair.mixing.receive({Time(), true, 0.0, 0.0, 0.0, 0.6}, Time());
  Setpoint off = kSticks;
  off.motors_on = false;
  pair.expectAlike(off, off, Time(), "whatever the program wants");
}

}  // namespace
}  // namespace swiftlet::simulation
