// The links from the sensors to the computer: delay, order, loss and outages.
#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures.hpp"
#include "simulation/sensors/link.hpp"
#include "simulation/sensors/sensor_streams.hpp"
#include "simulation/setpoint_link.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;

/// Arrivals of messages that are ready every 10 ms; none for those that are lost.
std::vector<std::optional<Time>> arrivals(const LinkConfig& config, int messages) {
  Link link(config, 1, "laser");
  std::vector<std::optional<Time>> arrived;
  for (int frame = 0; frame < messages; ++frame)
    arrived.push_back(link.arrival(static_cast<std::uint64_t>(frame), Time::fromSeconds(0.01 * frame)));
  return arrived;
}

TEST(Link, DelaysMessagesInOrder) {
  const auto arrived = arrivals({.latency_s = 0.01, .jitter_s = 0.05, .loss_rate = 0.0}, 1000);
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    ASSERT_TRUE(arrived[i]);
    EXPECT_GE(*arrived[i], Time::fromSeconds(0.01 * static_cast<double>(i)) + Duration::fromSeconds(0.01));
    if (i > 0) {
      EXPECT_GE(*arrived[i], *arrived[i - 1]) << "nothing overtakes";
    }
  }
}

TEST(Link, MessagesOvertakeEachOtherWhereOrderIsNotKept) {
  const auto arrived = arrivals({.latency_s = 0.01, .jitter_s = 0.05, .loss_rate = 0.0, .in_order = false}, 1000);
  int overtaken = 0;
  for (std::size_t i = 0; i + 1 < arrived.size(); ++i) {
    const double late_s = arrived[i]->seconds() - 0.01 * static_cast<double>(i);
    EXPECT_GE(late_s, 0.01 - 1e-9);
    EXPECT_LE(late_s, 0.06 + 1e-9) << "no message waits for another";
    overtaken += *arrived[i + 1] < *arrived[i] ? 1 : 0;
  }
  EXPECT_GT(overtaken, 200);
  EXPECT_LT(overtaken, 500);
}

TEST(Link, LosesTheGivenShare) {
  const auto arrived = arrivals({.loss_rate = 0.05}, 10'000);
  const auto lost = std::count(arrived.begin(), arrived.end(), std::nullopt);
  EXPECT_NEAR(static_cast<double>(lost), 500.0, 70.0);
}

TEST(Link, OutagesLoseEverythingForAWhile) {
  const auto arrived = arrivals({.outage_every_s = 2.0, .outage_s = 0.2}, 100'000);
  int bursts = 0, lost = 0;
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    if (arrived[i]) continue;
    ++lost;
    bursts += arrived[i - 1] ? 1 : 0;
  }
  EXPECT_NEAR(bursts, 1000.0 / 2.2, 60.0) << "on average every 2 s, while there is none";
  EXPECT_NEAR(static_cast<double>(lost) / bursts, 20.0, 1.0) << "messages in 0.2 s";
  const auto sound = arrivals({}, 1000);
  EXPECT_EQ(std::count(sound.begin(), sound.end(), std::nullopt), 0) << "and none by default";
}

TEST(Link, OutagesChangeNoDelayOfOtherMessages) {
  const auto sound = arrivals({.jitter_s = 0.01, .in_order = false}, 2000);
  const auto broken = arrivals({.jitter_s = 0.01, .in_order = false, .outage_every_s = 1.0}, 2000);
  int arrived = 0;
  for (std::size_t i = 0; i < sound.size(); ++i)
    if (broken[i]) {
      ++arrived;
      EXPECT_EQ(*broken[i], *sound[i]);
    }
  EXPECT_GT(arrived, 500);
  EXPECT_LT(arrived, 1999) << "there was no outage";
}

TEST(Link, ScansThatOvertakeAreDeliveredByTheirArrival) {
  Scenario scenario;
  scenario.sensors.laser_link = {.latency_s = 0.005, .jitter_s = 0.06, .loss_rate = 0.0, .in_order = false};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  ASSERT_TRUE(pilot.fly(3));
  const auto scans = eventsOf<Scan>(pilot.events);
  int reordered = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    EXPECT_GE(scans[i]->stamps.arrived, scans[i - 1]->stamps.arrived);
    reordered += scans[i]->stamps.measured < scans[i - 1]->stamps.measured ? 1 : 0;
  }
  EXPECT_GT(reordered, 5);
}

TEST(SetpointLink, DeliversInTheOrderOfSendingAndOnlyWhatHasArrived) {
  SetpointLink link({.latency_s = 0.02, .jitter_s = 0.05, .loss_rate = 0.0, .in_order = false}, 1);
  for (int i = 0; i < 100; ++i) {
    common::Setpoint setpoint;
    setpoint.thrust = i;
    link.send(Time::fromSeconds(0.01 * i), setpoint);
  }
  EXPECT_FALSE(link.next(Time::fromSeconds(0.019)));
  int received = 0;
  for (int ms = 20; ms < 2000; ++ms)
    while (const auto arrived = link.next(Time::fromSeconds(1e-3 * ms))) {
      EXPECT_EQ(arrived->setpoint.thrust, received++);
      EXPECT_LE(arrived->time, Time::fromSeconds(1e-3 * ms));
    }
  EXPECT_EQ(received, 100);
}

TEST(SensorClock, KeepsItsRateOverAFlight) {
  SensorClock clock(40.0);
  int frames = 0;
  for (int ms = 0; ms < 600'000; ++ms)
    for (; clock.due(Time::fromSeconds(1e-3 * ms)); ++clock.frame) ++frames;
  EXPECT_EQ(frames, 24'000);
}

}  // namespace
}  // namespace swiftlet::simulation
