// The wall clock: a vehicle that does not wait, jobs that are delivered when they are done; the same loop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "autonomy/loop/flight_loop.hpp"
#include "autonomy/loop/recording.hpp"
#include "common/mailbox.hpp"
#include "tests/flight_loop/short_flight.hpp"

namespace swiftlet::autonomy {
namespace {

using common::JobDelivery;
using common::Time;

/// The time of a flight, from its start, at a multiple of the wall clock.
class WallClock {
 public:
  explicit WallClock(double speed) : speed_(speed) {}
  Time now() const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
    return Time::fromSeconds(passed.count() * speed_);
  }
  void sleepUntil(Time time) const {
    const auto wall = std::chrono::duration<double>(time.seconds() / speed_);
    std::this_thread::sleep_until(begin_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(wall));
  }

 private:
  double speed_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// The simulator's vehicle, made to wait like a real one.
class PacedVehicle final : public common::Vehicle {
 public:
  PacedVehicle(common::Vehicle& vehicle, const WallClock& clock) : vehicle_(vehicle), clock_(clock) {}

  Time now() const override { return vehicle_.now(); }
  bool advanceTo(Time time, std::vector<common::SensorEvent>& events) override {
    clock_.sleepUntil(time);
    return vehicle_.advanceTo(time, events);
  }
  void apply(const common::Setpoint& setpoint) override { vehicle_.apply(setpoint); }
  std::string stopReason() const override { return vehicle_.stopReason(); }

 private:
  common::Vehicle& vehicle_;
  const WallClock& clock_;
};

TEST(WallClock, FliesTwentySecondsThroughTheSameLoop) {
  constexpr double kSpeed = 4.0, kFlight_s = 20.0;
  const auto simulated = makeVehicle(12);
  const WallClock clock(kSpeed);
  PacedVehicle vehicle(*simulated, clock);
  Autonomy autonomy = makeAutonomy(common::makeWallClockJobs(1, [&] { return clock.now(); }));
  common::LosslessQueue<common::OperatorCommand> commands;
  InputRecorder recorder;
  Witness flown;
  FlightLoop loop(vehicle, autonomy, commands, {&recorder, &flown});
  while (loop.now() < Time::fromSeconds(kFlight_s)) ASSERT_TRUE(loop.step(loop.now() + common::kControlPeriod));
  EXPECT_GE(clock.now(), Time::fromSeconds(kFlight_s));
  EXPECT_TRUE(flown.heard("flying"));
  int delivered = 0, not_at_the_declared_time = 0;
  const auto declared_s = PlanningConfig{}.latency_s;
  for (const Input& input : recorder.recording()) {
    const auto* delivery = std::get_if<JobDelivery>(&input);
    if (delivery == nullptr) continue;
    ++delivered;
    if (delivery->kind == "planning" && (delivery->delivered - delivery->submitted).seconds() != declared_s)
      ++not_at_the_declared_time;
  }
  EXPECT_GE(delivered, 3);
  EXPECT_GE(not_at_the_declared_time, 1);

  // In lockstep the recording gives the same flight, whatever else the machine was doing.
  Autonomy again = makeAutonomy(common::makeLockstepJobs(0));
  Witness replayed;
  const auto outcome = replay(recorder.recording(), again, {&replayed});
  ASSERT_TRUE(outcome) << outcome.error();
  EXPECT_EQ(difference(flown, replayed), "");

  // At the end the loop reports which jobs took longer than declared.
  loop.finish();
  const auto all = autonomy.jobs().times();
  ASSERT_FALSE(all.empty());
  for (const common::JobTimes& times : all) {
    EXPECT_GT(times.count, 0) << times.kind;
    EXPECT_LE(times.median, times.p99) << times.kind;
    EXPECT_EQ(flown.heard("jobs: " + times.kind + " is slower than declared"), times.tooSlow()) << times.kind;
  }
}

}  // namespace
}  // namespace swiftlet::autonomy
