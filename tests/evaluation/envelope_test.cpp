// The search for the boundary of an envelope on functions instead of flights, and what may be turned up.
#include "evaluation/envelope.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "common/error.hpp"
#include "simulation/plant_keys.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::evaluation {
namespace {

namespace fs = std::filesystem;
using test_support::HasProblem;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::IsEmpty;

/// Whether a flight at a value with a seed is acceptable.
using Plant = std::function<bool(double value, int seed)>;

EnvelopeStep flownAt(double value, int seeds, const Plant& plant) {
  EnvelopeStep step{value, {}};
  for (int seed = 1; seed <= seeds; ++seed) {
    EnvelopeFlight& flight = step.flights.emplace_back();
    flight.seed = seed;
    flight.acceptable = plant(value, seed);
    if (!flight.acceptable) break;
  }
  return step;
}

/// The search from `from` to `to`, with the values in the order in which they were flown.
struct Searched {
  EnvelopeFinding finding;
  std::vector<double> order;
};

Searched searched(const EnvelopeConfig& config, double from, double to, const Plant& plant) {
  Searched result;
  result.finding.quantity = {"quadrotor.motor_lag_s", to, ""};
  result.finding.from = from;
  result.finding.add(flownAt(from, config.seeds, plant));
  while (const auto value = nextValue(result.finding, config)) {
    result.order.push_back(*value);
    result.finding.add(flownAt(*value, config.seeds, plant));
    if (result.order.size() > 1000) break;
  }
  return result;
}

EnvelopeConfig config(int seeds, int steps, int bisections) {
  EnvelopeConfig config;
  config.seeds = seeds;
  config.steps = steps;
  config.bisections = bisections;
  return config;
}

TEST(EnvelopeSearch, StepsOverTheRangeAndThenBisectsTheBoundary) {
  const auto result = searched(config(2, 4, 3), 0, 8, [](double value, int) { return value < 4.6; });
  EXPECT_THAT(result.order, ElementsAre(2, 4, 6, 8, 5, 4.5, 4.75));
  EXPECT_EQ(result.finding.acceptableTo(), 4.5);
  EXPECT_EQ(result.finding.firstFailing()->value, 4.75);
  EXPECT_THAT(result.finding.acceptableBeyond(), IsEmpty());
}

TEST(EnvelopeSearch, GoesDownWhereTheEndIsBelowTheBase) {
  const auto result = searched(config(1, 2, 2), 1.0, 0.2, [](double value, int) { return value > 0.55; });
  EXPECT_NEAR(*result.finding.acceptableTo(), 0.6, 1e-12);
  EXPECT_NEAR(result.finding.firstFailing()->value, 0.5, 1e-12);
}

TEST(EnvelopeSearch, EndsAfterTheStepsWhereNothingFails) {
  const auto result = searched(config(3, 5, 4), 0, 1, [](double, int) { return true; });
  EXPECT_EQ(result.order.size(), 5u);
  EXPECT_EQ(result.finding.firstFailing(), nullptr);
  EXPECT_EQ(result.finding.acceptableTo(), 1.0);
}

TEST(EnvelopeSearch, ClosesInOnTheBaseWhereEverythingElseFails) {
  const auto result = searched(config(1, 2, 3), 0, 16, [](double value, int) { return value == 0; });
  EXPECT_EQ(result.finding.acceptableTo(), 0.0);
  EXPECT_EQ(result.finding.firstFailing()->value, 1.0);
}

TEST(EnvelopeSearch, TurnsNothingUpWhereTheBaseFails) {
  const auto result = searched(config(1, 2, 3), 0, 1, [](double, int) { return false; });
  EXPECT_THAT(result.order, IsEmpty());
  EXPECT_FALSE(result.finding.acceptableTo());
}

// A resonance: what fails at a middle value may well fly beyond it. The boundary is where it fails first.
TEST(EnvelopeSearch, ReportsWhatIsAcceptableBeyondAFailure) {
  const auto result = searched(config(1, 8, 2), 0, 8, [](double value, int) { return value < 2.6 || value > 4.5; });
  EXPECT_EQ(result.finding.acceptableTo(), 2.5);
  EXPECT_EQ(result.finding.firstFailing()->value, 2.75);
  EXPECT_THAT(result.finding.acceptableBeyond(), ElementsAre(5, 6, 7, 8));
}

TEST(EnvelopeSearch, OneSeedThatFailsIsEnoughAndTheLast) {
  const EnvelopeStep step = flownAt(1.0, 5, [](double, int seed) { return seed != 3; });
  EXPECT_FALSE(step.acceptable());
  EXPECT_EQ(step.flights.size(), 3u);
  EXPECT_FALSE(EnvelopeStep().acceptable()) << "nothing was flown";
}

// The oracle knows the threshold.
RC_GTEST_PROP(EnvelopeSearch, BracketsEveryThreshold, ()) {
  const double to = *rc::gen::suchThat(rc::gen::inRange(-50, 50), [](int value) { return value != 0; });
  const double edge = *rc::gen::inRange(1, 120) / 100.0;
  const int steps = *rc::gen::inRange(1, 9), bisections = *rc::gen::inRange(0, 7);
  const auto result =
      searched(config(1, steps, bisections), 0, to, [&](double value, int) { return value / to < edge; });
  RC_ASSERT(result.finding.share(*result.finding.acceptableTo()) < edge);
  RC_ASSERT(static_cast<int>(result.order.size()) <= steps + bisections);
  if (edge > 1.0) {
    RC_ASSERT(result.finding.firstFailing() == nullptr);
    return;
  }
  const double width =
      result.finding.share(result.finding.firstFailing()->value) - result.finding.share(*result.finding.acceptableTo());
  RC_ASSERT(result.finding.share(result.finding.firstFailing()->value) >= edge);
  RC_ASSERT(std::abs(width - 1.0 / steps / std::pow(2.0, bisections)) < 1e-9);
}

// Flights of which any may fail: what is reported must be what was flown, and no value is flown twice.
RC_GTEST_PROP(EnvelopeSearch, IsHonestAboutNoise, (std::uint32_t noise)) {
  const int steps = *rc::gen::inRange(1, 9), bisections = *rc::gen::inRange(0, 7);
  const auto lucky = [noise](double value, int seed) {
    return value == 0 || (std::hash<double>()(value * (seed + 1)) ^ noise) % 5 != 0;
  };
  const auto result = searched(config(2, steps, bisections), 0, 3, lucky);
  RC_ASSERT(static_cast<int>(result.order.size()) <= steps + bisections);
  RC_ASSERT(std::set<double>(result.order.begin(), result.order.end()).size() == result.order.size());
  std::size_t good = 0;
  while (good < result.finding.steps.size() && result.finding.steps[good].acceptable()) ++good;
  RC_ASSERT(*result.finding.acceptableTo() == result.finding.steps[good - 1].value);
  const EnvelopeStep* failing = result.finding.firstFailing();
  const bool all = good == result.finding.steps.size();
  RC_ASSERT(failing == (all ? nullptr : &result.finding.steps[good]));
  std::size_t beyond = 0;
  for (std::size_t i = good; i < result.finding.steps.size(); ++i) beyond += result.finding.steps[i].acceptable();
  RC_ASSERT(beyond == result.finding.acceptableBeyond().size());
}

TEST(EnvelopeFlightTest, IsAsAcceptableAsItsWorstVehicle) {
  FlightScore landed, crashed;
  landed.seed = crashed.seed = 7;
  landed.verdict = Verdict::kLanded;
  landed.verdict_reason = "the battery is low";
  crashed.verdict = Verdict::kCrashed;
  crashed.outcome = "touched box_1";
  EXPECT_TRUE(envelopeFlight({landed}).acceptable);
  EXPECT_EQ(envelopeFlight({landed}).ending, "the battery is low");
  for (const auto& scores : {std::vector{landed, crashed}, {crashed, landed}}) {
    EXPECT_FALSE(envelopeFlight(scores).acceptable);
    EXPECT_EQ(envelopeFlight(scores).verdict, "crashed");
    EXPECT_EQ(envelopeFlight(scores).ending, "touched box_1");
  }
}

class EnvelopeFile : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }
  std::vector<common::Problem> problemOf(const std::string& text) {
    std::ofstream(file_) << text;
    return problemsOf([&] { readEnvelope(file_); });
  }
  fs::path file_ = fs::temp_directory_path() / ("swiftlet-envelope-" + std::to_string(::getpid()) + ".yaml");
};

TEST_F(EnvelopeFile, SaysWhereAMistakeStands) {
  const std::string list = "seeds: 2\nquantities:\n";
  EXPECT_THAT(problemOf(list + "  - {key: battery_remaining, to: 0.2}\n"), IsEmpty());
  struct Mistake {
    std::string text, name, place, says;
  };
  for (const Mistake& mistake : std::vector<Mistake>{
           {list + "  - {key: quadrotor.motor_lag, to: 0.1}\n", "envelope.no-number", "3:11: quantities[0].key",
            "`quadrotor.motor_lag_s`"},
           {list + "  - {key: walkers, to: 0.1}\n", "envelope.no-number", "3:11: quantities[0].key", "`walkers`"},
           {list + "  - {key: quadrotor.weak_motor, to: 4}\n", "envelope.counts", "3:11: quantities[0].key", ""},
           {list + "  - {key: quadrotor.motor_lag_s, to: 5}\n", "config.not-within", "3:38: quantities[0].to",
            "0.005 and 0.5, the bounds of `quadrotor.motor_lag_s`"},
           {list + "  - {key: quadrotor.motor_lag_s}\n", "config.missing", "3:5: quantities[0].to", ""},
           {list + "  - {to: 5}\n", "config.missing", "3:5: quantities[0].key", ""},
           {list + "  - {key: battery_remaining, to: 0.2}\n  - {key: battery_remaining, to: 0.2}\n", "envelope.twice",
            "quantities", ""},
           {"seeds: 2\n", "envelope.nothing", "1:1: quantities", ""},
           {"seeds: 0\nquantities: [{key: battery_remaining, to: 0.2}]\n", "config.not-within", "1:8: seeds", ""}})
    EXPECT_THAT(problemOf(mistake.text), HasProblem(mistake.name, mistake.place, mistake.says)) << mistake.text;
}

simulation::Nature nominal() { return simulation::Nature::load(SWIFTLET_SOURCE_DIR "/config/nature/nominal.yaml"); }

TEST(EnvelopeBase, PinsChargeAndWindButNotTheScene) {
  simulation::Scenario scenario;
  scenario.variation.battery_remaining = 0.1;
  scenario.variation.wind_m_s = 0.2;
  scenario.variation.obstacle_m = 0.4;
  scenario.written = {"variation.battery_remaining", "variation.wind_m_s"};
  const simulation::Scenario base = pinned(scenario, nominal());
  for (const std::uint64_t seed : {1, 2, 3}) {
    const simulation::Scenario drawn = base.nature->drawn(base, seed);
    EXPECT_EQ(drawn.battery_remaining, 1.0);
    EXPECT_EQ(drawn.variation.wind_m_s, 0.0);
    EXPECT_EQ(drawn.variation.obstacle_m, 0.4);
  }
}

TEST(EnvelopeBase, AQuantityThatIsTurnedUpIsAllThatDiffers) {
  simulation::Scenario base = pinned({}, nominal());
  const auto before = simulation::plantKeys(base.nature->drawn(base, 4));
  setPlantKey(base, "sensors.laser_link.latency_s", 0.2);
  const auto after = simulation::plantKeys(base.nature->drawn(base, 4));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(after[i].value, before[i].key == "sensors.laser_link.latency_s" ? 0.2 : before[i].value) << before[i].key;
}

TEST(EnvelopeBase, AHeavyVehicleIsNotLiftedByAnotherCharge) {
  simulation::Scenario base = pinned({}, nominal());
  setPlantKey(base, "quadrotor.mass_share", 1.9);
  EXPECT_EQ(base.nature->drawn(base, 1).quadrotor.mass_share, 1.9);
}

TEST(EnvelopeBase, ThatDrawsTheQuantityIsRefused) {
  const auto base = pinned({}, simulation::Nature::load(SWIFTLET_SOURCE_DIR "/config/nature/real.yaml"));
  EXPECT_THROW(baseValue({"quadrotor.motor_lag_s", 0.2, ""}, base), common::InputError);
  EXPECT_EQ(baseValue({"quadrotor.inertia_xx_kg_m2", 0.2, ""}, base), 0.020);
  EXPECT_THROW(baseValue({"quadrotor.motor_lag_s", 0.035, ""}, pinned({}, nominal())), common::InputError)
      << "there is nothing between base and end";
}

// Every quantity of the shipped file begins at a value that the base has, and its range reaches as far as `harsh` draws
// it.
TEST(EnvelopeBase, TheShippedQuantitiesCoverWhatHarshDraws) {
  const auto base = pinned({}, nominal());
  const auto harsh = simulation::Nature::load(SWIFTLET_SOURCE_DIR "/config/nature/harsh.yaml");
  int drawn = 0;
  for (const EnvelopeQuantity& quantity : readEnvelope(SWIFTLET_SOURCE_DIR "/config/envelope.yaml").quantities) {
    const double from = baseValue(quantity, base);
    const auto range = harsh.rangeOf(quantity.key);
    if (!range) continue;
    ++drawn;
    const double worst = quantity.to > from ? range->high : range->low;
    EXPECT_LE((worst - from) / (quantity.to - from), 1.0) << quantity.key;
  }
  EXPECT_GE(drawn, 10);
}

}  // namespace
}  // namespace swiftlet::evaluation
