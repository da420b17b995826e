// What a nature draws: from which ranges, by which seed, what wins over it, and that the vehicle can fly.
#include "simulation/nature.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "arena_fixtures.hpp"
#include "common/config.hpp"
#include "common/error.hpp"
#include "event_bytes.hpp"
#include "simulation/variation.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::HasProblem;
using test_support::ProblemIs;
using test_support::problemsOf;
using ::testing::AllOf;
using testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;

constexpr int kSeeds = 300;

std::string text(const Scenario& scenario) {
  using common::config::YamlPrinter;
  return YamlPrinter(YamlPrinter::Comments::kNo).print(scenario);
}

Nature shipped(const std::string& name) { return Nature::load(SWIFTLET_SOURCE_DIR "/config/nature/" + name + ".yaml"); }

std::vector<common::Problem> refusalOf(const std::string& yaml) {
  return problemsOf([&] { (void)Nature::fromText(yaml, "odd.yaml"); });
}

/// A short flight by the truth.
std::string flownBytes(const Scenario& scenario) {
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0.5, 0, 1);
  EXPECT_TRUE(pilot.fly(1.5)) << vehicle.stopReason();
  return bytesOf(pilot.events, false);
}

TEST(Nature, CalmChangesNothing) {
  Scenario scenario;
  scenario.battery_remaining = 0.6;
  EXPECT_EQ(text(shipped("calm").drawn(scenario, 3)), text(scenario));
  EXPECT_EQ(text(Nature::calm().drawn(scenario, 3)), text(scenario));
  scenario.vehicle.mass_kg = 10.0;
  EXPECT_EQ(shipped("calm").drawn(scenario, 3).battery_remaining, 0.6) << "even for a vehicle that cannot fly";
}

TEST(Nature, AFlightInCalmHasTheBytesOfOneWithoutNature) {
  Scenario plain, calm;
  calm.nature = std::make_shared<const Nature>(shipped("calm"));
  EXPECT_EQ(flownBytes(plain), flownBytes(calm));
  Scenario real;
  real.nature = std::make_shared<const Nature>(shipped("real"));
  EXPECT_NE(flownBytes(plain), flownBytes(real));
}

TEST(Nature, OnlyTheSameSeedDrawsTheSame) {
  const Nature real = shipped("real");
  EXPECT_EQ(text(real.drawn({}, 11)), text(real.drawn({}, 11)));
  EXPECT_NE(text(real.drawn({}, 11)), text(real.drawn({}, 12)));
}

TEST(Nature, AWrittenKeyWinsAndShiftsNoOtherDraw) {
  const Nature real = shipped("real");
  Scenario written;
  written.quadrotor.motor_lag_s = 0.08;
  written.sensors.laser_link.latency_s = 0.2;
  written.written = {"quadrotor.motor_lag_s", "sensors.laser_link.latency_s"};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scenario free = real.drawn({}, seed);
    const Scenario bound = real.drawn(written, seed);
    EXPECT_EQ(bound.quadrotor.motor_lag_s, 0.08);
    EXPECT_EQ(bound.sensors.laser_link.latency_s, 0.2);
    EXPECT_EQ(bound.sensors.laser_link.loss_rate, free.sensors.laser_link.loss_rate) << "its neighbour is drawn";
    free.quadrotor.motor_lag_s = 0.08;
    free.sensors.laser_link.latency_s = 0.2;
    EXPECT_EQ(text(bound), text(free)) << "seed " << seed;
  }
}

TEST(Nature, EveryDrawIsWithinItsRangeAndTheRangeIsUsed) {
  const Nature nature = Nature::fromText(
      "least_thrust_over_weight: 0\n"
      "quadrotor: {mass_share: [0.9, 1.1], weak_motor: [1, 4]}\n"
      "sensors:\n  laser_errors:\n    clock_offset_s: [-0.005, 0.005]\n",
      "three.yaml");
  double least = 2.0, greatest = 0.0;
  std::array<int, 5> weak{};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Scenario drawn = nature.drawn({}, seed);
    ASSERT_THAT(drawn.quadrotor.mass_share, AllOf(Ge(0.9), Le(1.1)));
    ASSERT_THAT(drawn.sensors.laser_errors.clock_offset_s, AllOf(Ge(-0.005), Le(0.005)));
    ASSERT_THAT(drawn.quadrotor.weak_motor, AllOf(Ge(1), Le(4)));
    least = std::min(least, drawn.quadrotor.mass_share);
    greatest = std::max(greatest, drawn.quadrotor.mass_share);
    ++weak[static_cast<std::size_t>(drawn.quadrotor.weak_motor)];
    EXPECT_EQ(drawn.quadrotor.inertia_xx_kg_m2, Scenario{}.quadrotor.inertia_xx_kg_m2) << "it is not in the file";
  }
  EXPECT_LT(least, 0.905);
  EXPECT_GT(greatest, 1.095);
  for (const int motor : {1, 2, 3, 4}) EXPECT_NEAR(weak[static_cast<std::size_t>(motor)], kSeeds / 4.0, 25) << motor;
}

TEST(Nature, TellsWhatAKeyIsDrawnFrom) {
  const Nature nature =
      Nature::fromText("quadrotor: {mass_share: [0.9, 1.1]}\nwind: {gust_m_s: 0.3, model: dryden}\n", "n");
  EXPECT_EQ(nature.rangeOf("quadrotor.mass_share")->low, 0.9);
  EXPECT_EQ(nature.rangeOf("quadrotor.mass_share")->high, 1.1);
  EXPECT_EQ(nature.rangeOf("wind.gust_m_s")->low, 0.3);
  EXPECT_EQ(nature.rangeOf("wind.gust_m_s")->high, 0.3);
  EXPECT_FALSE(nature.rangeOf("wind.model")) << "it is no number";
  EXPECT_FALSE(nature.rangeOf("quadrotor.thrust_share")) << "it is not drawn";
  EXPECT_FALSE(Nature::calm().rangeOf("quadrotor.mass_share"));
}

TEST(Nature, ADrawCanFly) {
  for (const auto& [name, least] : {std::pair("real", 1.15), std::pair("harsh", 1.05)}) {
    const Nature nature = shipped(name);
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const Scenario drawn = nature.drawn({}, seed);
      EXPECT_GE(thrustOverWeight(drawn.vehicle, drawn.quadrotor, drawn.battery_remaining, Nature::kFullThrottle), least)
          << name << ", seed " << seed;
    }
  }
}

TEST(Nature, ChargeIsRaisedUntilTheVehicleCanFlyButNotAWrittenOne) {
  const Nature tired = Nature::fromText("least_thrust_over_weight: 1.3\nbattery_remaining: [0.02, 0.05]\n", "tired");
  const Scenario drawn = tired.drawn({}, 1);
  EXPECT_GT(drawn.battery_remaining, 0.05);
  EXPECT_GE(thrustOverWeight(drawn.vehicle, drawn.quadrotor, drawn.battery_remaining, Nature::kFullThrottle), 1.3);
  EXPECT_LT(thrustOverWeight(drawn.vehicle, drawn.quadrotor, drawn.battery_remaining - 0.011, Nature::kFullThrottle),
            1.3)
      << "and no further";

  Scenario written;
  written.battery_remaining = 0.03;
  written.written = {"battery_remaining"};
  EXPECT_EQ(tired.drawn(written, 1).battery_remaining, 0.03);
}

TEST(Nature, AtAWrittenChargeTheRestIsDrawnAnewUntilTheVehicleCanFly) {
  const Nature heavy =
      Nature::fromText("least_thrust_over_weight: 1.3\nquadrotor: {mass_share: [0.8, 1.5]}\n", "heavy");
  Scenario written;
  written.battery_remaining = 0.9;
  written.written = {"battery_remaining"};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Scenario drawn = heavy.drawn(written, seed);
    EXPECT_EQ(drawn.battery_remaining, 0.9);
    EXPECT_GE(thrustOverWeight(drawn.vehicle, drawn.quadrotor, 0.9, Nature::kFullThrottle), 1.3) << "seed " << seed;
  }
}

TEST(Nature, ThatDrawsTheChargeReplacesTheScenariosVariationOfIt) {
  Scenario varied;
  varied.variation.battery_remaining = 0.1;
  varied.written = {"variation.battery_remaining"};
  const Scenario drawn = shipped("real").drawn(varied, 4);
  EXPECT_EQ(drawn.battery_remaining, shipped("real").drawn({}, 4).battery_remaining);
  EXPECT_EQ(drawn.variation.battery_remaining, 0.0);
  EXPECT_EQ(shipped("calm").drawn(varied, 4).variation.battery_remaining, 0.1) << "it draws no charge";

  varied.battery_remaining = 0.6;
  varied.written.emplace_back("battery_remaining");
  const Scenario written = shipped("real").drawn(varied, 4);
  EXPECT_EQ(written.battery_remaining, 0.6);
  EXPECT_EQ(written.variation.battery_remaining, 0.1) << "it varies the charge that is written out";
}

TEST(Nature, AnotherRangeOfTheChargeShiftsNoOtherDraw) {
  const Nature real = shipped("real"), charged = real.withCharge(0.9, 1.0);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Scenario drawn = charged.drawn({}, seed);
    EXPECT_GE(drawn.battery_remaining, 0.9);
    const Scenario before = real.drawn({}, seed);
    drawn.battery_remaining = before.battery_remaining;
    EXPECT_EQ(text(drawn), text(before)) << seed;
  }
  EXPECT_EQ(Nature::calm().withCharge(0.9, 1.0).drawn({}, 1).battery_remaining, 1.0);
  const Nature windy = Nature::fromText("wind: {gust_m_s: 1}\n", "windy.yaml").withCharge(0.5, 0.6);
  EXPECT_EQ(windy.drawn({}, 1).battery_remaining, 1.0) << "it draws no charge";
}

TEST(Nature, IsDrawnAnewWhenAFullBatteryIsTooWeak) {
  const Nature heavy =
      Nature::fromText("least_thrust_over_weight: 1.2\nquadrotor: {mass_share: [0.9, 1.9]}\n", "heavy.yaml");
  for (std::uint64_t seed = 0; seed < 50; ++seed) EXPECT_LT(heavy.drawn({}, seed).quadrotor.mass_share, 1.4);
  const Nature lead = Nature::fromText("quadrotor: {mass_share: [1.9, 2.0]}\n", "lead.yaml");
  EXPECT_THAT(problemsOf([&] { (void)lead.drawn({}, 1); }),
              ElementsAre(ProblemIs("nature.too-heavy", "lead.yaml: least_thrust_over_weight")));
}

TEST(Nature, MistakesAreToldWithFileLineAndKey) {
  EXPECT_THAT(refusalOf("wind:\n  model: dryden\nquadrotor:\n  mass_shar: [0.9, 1.1]\n"),
              HasProblem("config.unknown-key", "odd.yaml:4:3: quadrotor", "`mass_share`"));
  EXPECT_THAT(refusalOf("quadrotor:\n  mass_share: [1.1, 0.9]\n"),
              HasProblem("nature.upside-down", "odd.yaml:2:15: quadrotor.mass_share"));
  EXPECT_THAT(refusalOf("quadrotor:\n  mass_share: [0.9, 11]\n"),
              HasProblem("config.not-within", "odd.yaml:2:15: quadrotor.mass_share"));
  EXPECT_THAT(refusalOf("quadrotor:\n  # heavy\n  mass_share: [0.1, 1]\n"),
              HasProblem("config.not-within", "odd.yaml:3:15: quadrotor.mass_share"));
  EXPECT_THAT(refusalOf("quadrotor: {mass_share: [0.9, much]}\n"), HasProblem("nature.no-range"));
  EXPECT_THAT(refusalOf("quadrotor: {mass_share: [0.9, 1.0, 1.1]}\n"), HasProblem("nature.no-range"));
  EXPECT_THAT(refusalOf("quadrotor:\n  mass_share:\n    - 0.9\n    - 1.0\n"), HasProblem("nature.no-range"));
  EXPECT_THAT(refusalOf("quadrotor: {weak_motor: [1.5, 4]}\n"), HasProblem("nature.not-whole", "quadrotor.weak_motor"));
  EXPECT_THAT(refusalOf("quadrotor: {weak_motor: [1, 5]}\n"), HasProblem("config.not-within", "quadrotor.weak_motor"));
  EXPECT_THAT(refusalOf("autopilot: {mixing: [clamp_each, attitude_first]}\n"),
              HasProblem("nature.no-range", "autopilot.mixing"));
  EXPECT_THAT(refusalOf("world: a.sdf\n"), HasProblem("config.unknown-key", "odd.yaml:1:1"))
      << "a nature is the plant, not the flight";
  EXPECT_THAT(refusalOf("quadrotor: {mass_share: [0.9\n"), HasProblem("yaml.not-closed", "odd.yaml"));
  EXPECT_THAT(refusalOf("quadrotor: {mass_share: &r [0.9, 1.1], thrust_share: *r}\n"),
              HasProblem("nature.anchor", "odd.yaml:1:25: quadrotor.mass_share"));
  EXPECT_THAT(refusalOf("quadrotor:\n  mass_share: [0.9, # low\n    1.1]\n  mass_shar: 1\n"),
              HasProblem("config.unknown-key", "odd.yaml:4:3"))
      << "behind a range of two lines";
}

TEST(Nature, AMarkOfTheByteOrderAndCommentsInRangesAreNoMistakes) {
  std::string utf16 = "\xFF\xFE";
  for (const char letter : std::string("quadrotor:\r\n  mass_share: [0.9, 1.1]\r\n")) utf16 += {letter, '\0'};
  for (const std::string& text : {std::string("\xEF\xBB\xBFquadrotor:\n  mass_share: [0.9, 1.1]\n"), utf16,
                                  std::string("quadrotor:\n  mass_share: [0.9, # [low]\n    1.1] # high ]\n")}) {
    const auto range = Nature::fromText(text, "odd.yaml").rangeOf("quadrotor.mass_share");
    ASSERT_TRUE(range) << text;
    EXPECT_EQ(range->low, 0.9);
    EXPECT_EQ(range->high, 1.1);
  }
}

TEST(Nature, BasedOnAnotherDrawsWhatThatDrawsAndItsOwn) {
  const TemporaryFolder folder("nature_draughts");
  const Nature real = shipped("real"),
               draughty = Nature::load(folder.write("draughts.yaml", "based_on: real\nwind: {gust_m_s: [0.4, 0.8]}\n"));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scenario drawn = draughty.drawn({}, seed);
    EXPECT_THAT(drawn.wind.gust_m_s, AllOf(Ge(0.4), Le(0.8)));
    const std::string values = draughty.valuesIn(drawn);
    EXPECT_THAT(values, AllOf(HasSubstr("mass_share"), Not(HasSubstr("based_on"))));
    EXPECT_EQ(text(Nature::fromText(values, "nature.yaml").drawn({}, seed + 1000)), text(drawn));
    const Scenario calmer = real.drawn({}, seed);
    drawn.wind.gust_m_s = calmer.wind.gust_m_s;
    EXPECT_EQ(text(drawn), text(calmer)) << seed;
  }
}

/// Vibration that a bench does not show belongs to every workshop (docs/natures.md).
TEST(Nature, RealAndHarshRectifyVibration) {
  for (const auto& [name, greatest] : {std::pair("real", 0.2), std::pair("harsh", 0.4)}) {
    const auto range = shipped(name).rangeOf("sensors.imu.rectification_m_s2");
    ASSERT_TRUE(range) << name;
    EXPECT_EQ(range->low, 0.02) << name;
    EXPECT_EQ(range->high, greatest) << name;
  }
}

TEST(Nature, ItsOwnKeysReplaceThoseOfItsBase) {
  const TemporaryFolder folder("nature_bases");
  folder.write("first.yaml", "least_thrust_over_weight: 1.2\nquadrotor: {mass_share: [0.9, 1.1], thrust_share: 0.9}\n");
  folder.write("second.yaml", "based_on: first.yaml\nquadrotor: {mass_share: 1.05}\n");
  const Nature third =
      Nature::load(folder.write("third.yaml", "based_on: second.yaml\nquadrotor: {thrust_share: [0.95, 1.0]}\n"));
  EXPECT_EQ(third.rangeOf("quadrotor.mass_share")->high, 1.05);
  EXPECT_EQ(third.rangeOf("quadrotor.thrust_share")->low, 0.95);
  const Scenario drawn = third.drawn({}, 1);
  EXPECT_GE(thrustOverWeight(drawn.vehicle, drawn.quadrotor, drawn.battery_remaining, Nature::kFullThrottle), 1.2);
}

TEST(Nature, MistakesOfABaseAreToldWithTheirPlace) {
  const auto problemOf = [](const std::string& text) {
    return problemsOf([&] { (void)Nature::fromText(text, "odd.yaml"); });
  };
  EXPECT_THAT(problemOf("quadrotor: {mass_share: 1}\nbased_on: raal\n"),
              HasProblem("", "odd.yaml:2:11: based_on", "raal"));
  EXPECT_THAT(problemOf("based_on: [0, 1]\n"), HasProblem("nature.no-name-of", "odd.yaml:1:11: based_on"));
  EXPECT_THAT(problemOf("based_on:\n"), HasProblem("nature.no-name-of", "based_on"));
  EXPECT_THAT(problemOf("based_on: real\nquadrotor:\n  mass_share: [0.9, 11]\n"),
              HasProblem("", "odd.yaml:3:15: quadrotor.mass_share", "11"));
  const TemporaryFolder folder("nature_circles");
  const auto problem = [](const std::string& file) {
    try {
      (void)Nature::load(file);
    } catch (const common::InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(problem(folder.write("one.yaml", "based_on: ./one.yaml\n")),
              HasSubstr("one.yaml:1:11: based_on: ./one.yaml is based on this nature itself"));
  folder.write("a.yaml", "based_on: b.yaml\n");
  EXPECT_THAT(problem(folder.write("b.yaml", "wind: {gust_m_s: 1}\nbased_on: a.yaml\n")),
              HasSubstr("a.yaml:1:11: based_on: b.yaml is based on this nature itself"));
  folder.write("bad.yaml", "wind: {gust: 1}\n");
  EXPECT_THAT(problem(folder.write("good.yaml", "based_on: bad.yaml\n")), HasSubstr("bad.yaml:1:8: wind: unknown key"));
}

TEST(Nature, WithoutANameIsRefused) { EXPECT_THROW((void)Nature::load(""), common::InputError); }

TEST(Nature, RecordsItsValuesAsANatureThatDrawsThemAgain) {
  const Nature real = shipped("real");
  EXPECT_EQ(Nature::calm().valuesIn({}), "");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenario drawn = real.drawn({}, seed);
    const std::string values = real.valuesIn(drawn);
    EXPECT_EQ(values.find('['), std::string::npos) << values;
    EXPECT_EQ(text(Nature::fromText(values, "nature.yaml").drawn({}, seed + 1000)), text(drawn)) << values;
  }
}

TEST(Nature, EachOfSeveralVehiclesDrawsItsOwnAndWindIsShared) {
  Scenario scenario = scenarioOf({vehicleAt("alpha", -2, 0), vehicleAt("beta", 2, 0)});
  scenario.vehicles[1].battery_remaining = 0.77;
  scenario.written = {"vehicles[1].battery_remaining"};
  scenario.nature = std::make_shared<const Nature>(Nature::fromText(
      "battery_remaining: [0.5, 0.7]\nquadrotor: {mass_share: [0.9, 1.1]}\nwind: {gust_m_s: [0, 1]}\n", "own.yaml"));
  const Realization both = realize(boxRoom(), scenario);
  const Scenario &alpha = both.vehicles.at(0).scenario, &beta = both.vehicles.at(1).scenario;
  EXPECT_NE(alpha.quadrotor.mass_share, beta.quadrotor.mass_share);
  EXPECT_THAT(alpha.battery_remaining, AllOf(Ge(0.5), Le(0.7)));
  EXPECT_EQ(beta.battery_remaining, 0.77) << "it is written";
  EXPECT_EQ(alpha.wind.gust_m_s, beta.wind.gust_m_s) << "there is one air";

  Scenario first = scenario;
  first.vehicles.pop_back();
  EXPECT_EQ(realize(boxRoom(), first).vehicles.at(0).scenario.quadrotor.mass_share, alpha.quadrotor.mass_share)
      << "a second vehicle changes nothing for the first";
}

}  // namespace
}  // namespace swiftlet::simulation
