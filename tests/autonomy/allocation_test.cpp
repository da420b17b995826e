// No heap use in the 100 Hz tick: from the tick to the setpoint, in flight, while a trajectory is followed, and in the
// descent of a vehicle that has lost its inertial samples. What happens less often may allocate: a scan is matched and
// mapped, a snapshot of the world is made and the mission is ticked, a job is delivered.
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "autonomy/autonomy.hpp"
#include "common/world/vehicle_layer.hpp"
#include "tests/autonomy/autonomy_story.hpp"
#include "tests/support/allocations/counted_allocations.hpp"

namespace swiftlet::autonomy {
namespace {

/// Flies the vehicle of the stories as FlightLoop does, and counts what the autonomy allocates by each kind of input.
class CountedFlight {
 public:
  explicit CountedFlight(const std::string& leaves)
      : vehicle_(storyRoom(), storyScenario()),
        autonomy_({.vehicle = vehicle_.scenario().vehicle,
                   .laser = vehicle_.scenario().laser,
                   .mission = storyMission(leaves),
                   .jobs = common::makeLockstepJobs(0)}) {}

  bool inertial_samples_arrive = true;
  long by_ticks = 0, by_samples = 0;  ///< Allocations by ticks that do nothing but control; by samples.
  int ticks = 0, samples = 0;

  [[nodiscard]] bool step() {
    const common::Time now = vehicle_.now() + common::kControlPeriod;
    std::vector<common::SensorEvent> events;
    if (!vehicle_.advanceTo(now, events)) return false;
    for (const common::SensorEvent& event : events) {
      deliverDue(common::stampsOf(event).arrived);
      const bool inertial = std::holds_alternative<common::ImuSample>(event);
      if (inertial && !inertial_samples_arrive) continue;
      const bool small = inertial || std::holds_alternative<common::BatterySample>(event) ||
                         std::holds_alternative<common::PilotSample>(event);
      const long made = give(event);
      if (!small) continue;
      by_samples += made;
      ++samples;
    }
    deliverDue(now);
    tick(now);
    return true;
  }
  template <typename Condition>
  [[nodiscard]] bool until(Condition condition, double at_most_s) {
    const common::Time end = vehicle_.now() + common::Duration::fromSeconds(at_most_s);
    while (!condition())
      if (vehicle_.now() >= end || !step()) return false;
    return true;
  }
  [[nodiscard]] bool reaches(FlightState state, double at_most_s) {
    return until([this, state] { return autonomy_.world()->vehicle->flight_state == state; }, at_most_s);
  }
  /// False if the vehicle crashes.
  [[nodiscard]] bool fly(double seconds) {
    (void)until([] { return false; }, seconds);
    return vehicle_.stopReason().empty();
  }
  void forget() { by_ticks = by_samples = ticks = samples = 0; }
  double speed_m_s() const { return autonomy_.state().velocity_odom_m_s.norm(); }

 private:
  long give(const Input& input) {
    const long before = test_support::allocations;
    const std::optional<common::Setpoint> setpoint = autonomy_.process(input);
    const long made = test_support::allocations - before;
    if (setpoint) vehicle_.apply(*setpoint);
    return made;
  }
  void deliverDue(common::Time now) {
    while (const auto delivery = autonomy_.jobs().nextDue(now)) (void)give(*delivery);
  }
  /// The behaviours, which make a snapshot, and the scans run inside some of the ticks.
  void tick(common::Time now) {
    const common::World* const world = autonomy_.world().get();
    const std::uint64_t scans = autonomy_.counts().estimator.odometry.scans;
    const long made = give(Tick{now});
    if (autonomy_.world().get() != world || autonomy_.counts().estimator.odometry.scans != scans) return;
    by_ticks += made;
    ++ticks;
  }

  simulation::SimulatedVehicle vehicle_;
  Autonomy autonomy_;
};

TEST(Allocation, NoTickInFlightMakesOne) {
  CountedFlight flight(R"(<TakeOff height_m="1.0"/><FollowPath points="2;-2 | -2;-2 | -2;2 | 2;0"/><Land/>)");
  ASSERT_TRUE(flight.reaches(FlightState::kFlying, 15.0));
  ASSERT_TRUE(flight.until([&] { return flight.speed_m_s() > 0.3; }, 5.0));
  flight.forget();
  ASSERT_TRUE(flight.fly(10.0));
  EXPECT_GT(flight.ticks, 300) << "of 1000, those without a scan and without the behaviours";
  EXPECT_GT(flight.samples, 1900);
  EXPECT_EQ(flight.by_ticks, 0);
  EXPECT_EQ(flight.by_samples, 0);
}

TEST(Allocation, NorDoesOneWithoutInertialSamples) {
  CountedFlight flight(R"(<TakeOff height_m="1.0"/><FollowPath points="2;-2 | -2;-2 | -2;2 | 2;0"/><Land/>)");
  ASSERT_TRUE(flight.reaches(FlightState::kFlying, 15.0));
  flight.inertial_samples_arrive = false;
  ASSERT_TRUE(flight.reaches(FlightState::kEmergencyLanding, 3.0));
  ASSERT_TRUE(flight.fly(0.2));
  flight.forget();
  ASSERT_TRUE(flight.fly(1.0));
  EXPECT_GT(flight.ticks, 30);
  EXPECT_EQ(flight.by_ticks, 0);
}

}  // namespace
}  // namespace swiftlet::autonomy
