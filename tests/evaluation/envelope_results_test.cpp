// What is made of an envelope for people and programs.
#include "evaluation/envelope_results.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace swiftlet::evaluation {
namespace {

using testing::ElementsAre;

EnvelopeStep step(double value, bool acceptable) {
  return {value, {{7, acceptable, acceptable ? "done" : "crash", acceptable ? "done" : "touched box_1", 0.02, ""}}};
}

/// From 0 to 1; `harsh` draws up to `harsh`.
EnvelopeEntry entry(const std::string& key, double acceptable_to, std::optional<double> fails_at,
                    std::optional<double> harsh) {
  EnvelopeEntry entry;
  entry.finding.quantity = {key, 1.0, "name of " + key};
  entry.finding.steps = {step(0.0, true), step(acceptable_to, true)};
  if (fails_at) entry.finding.steps.push_back(step(*fails_at, false));
  if (harsh) entry.harsh = simulation::NatureRange{-*harsh, *harsh};
  entry.finding.complete = true;
  return entry;
}

EnvelopeResults example() {
  EnvelopeResults results;
  results.trial = "lab";
  results.base = step(0.0, true);
  results.entries = {entry("a_s", 1.0, std::nullopt, 0.5), entry("b_s", 0.4, 0.5, std::nullopt),
                     entry("c_s", 0.2, 0.3, 0.1), entry("d_s", 0.6, 0.7, 0.5)};
  return results;
}

std::vector<std::string> columnOf(const common::Table& table, std::size_t column) {
  std::vector<std::string> texts;
  for (const auto& row : table.rows) texts.push_back(row.at(column).text);
  return texts;
}

// c fails at 3 times what harsh draws and d at 1.4 times, although d flies farther.
TEST(EnvelopeResults, AreOrderedByTheReserveBeyondHarsh) {
  EXPECT_THAT(columnOf(envelopeTable(example()), 0),
              ElementsAre("name of d_s", "name of c_s", "name of b_s", "name of a_s"));
  EXPECT_THAT(columnOf(envelopeTable(example()), 6), ElementsAre("700 ms", "300 ms", "500 ms", "not up to 1e+03 ms"));
  EXPECT_THAT(columnOf(envelopeTable(example()), 7), ElementsAre("1.4", "3.0", "-", "-"));
}

TEST(EnvelopeResults, ListEveryFailedFlight) {
  const common::Table table = failedFlightTable(example());
  EXPECT_THAT(columnOf(table, 4), ElementsAre("touched box_1", "touched box_1", "touched box_1"));
  EXPECT_EQ(example().flights(), 1 + 1 + 2 + 2 + 2);
}

TEST(EnvelopeResults, ARangeInOneDirectionCountsInThatDirectionOnly) {
  EnvelopeEntry down = entry("e_s", 0.2, 0.3, std::nullopt);
  down.harsh = simulation::NatureRange{-2.0, 0.0};
  EXPECT_FALSE(down.worstOf(down.harsh)) << "it is turned up, and harsh only draws below the base";
  down.finding.quantity.to = -4.0;
  EXPECT_EQ(down.harshMultiple(-4.0), 2.0);
}

TEST(EnvelopeResults, ValuesHaveTheUnitOfTheirKey) {
  EXPECT_EQ(shownValue("quadrotor.motor_lag_s", 0.0412), "41.2 ms");
  EXPECT_EQ(shownValue("wind.gust_m_s", 0.8), "0.8 m/s");
  EXPECT_EQ(shownValue("sensors.imu.vibration_m_s2", 1.5), "1.5 m/s2");
  EXPECT_EQ(shownValue("autopilot.rate_gain_1_s", 18), "18 1/s");
  EXPECT_EQ(shownValue("battery_remaining", 0.325), "32.5 %");
  EXPECT_EQ(shownValue("quadrotor.throttle_exponent", 1.25), "1.25");
}

TEST(EnvelopeResults, AsJsonHaveEveryStep) {
  EnvelopeResults results = example();
  results.entries[1].finding.add(step(0.8, true));
  results.entries[2].finding.complete = false;
  const auto read = nlohmann::json::parse(toJson(results));
  EXPECT_EQ(read.at("envelope"), "lab");
  EXPECT_EQ(read.at("complete"), false);
  const auto b = read.at("quantities")[1];
  EXPECT_EQ(b.at("acceptable_to"), 0.4);
  EXPECT_EQ(b.at("fails_at"), 0.5);
  EXPECT_EQ(b.at("acceptable_beyond"), nlohmann::json({0.8}));
  EXPECT_EQ(b.at("harsh"), nullptr);
  EXPECT_EQ(b.at("steps").size(), 4u);
  EXPECT_EQ(b.at("steps")[2].at("flights")[0].at("ending"), "touched box_1");
  EXPECT_EQ(columnOf(raggedTable(results), 2), std::vector<std::string>{"800 ms"});
}

// A crash with nothing turned up says nothing about any quantity.
TEST(EnvelopeResults, AreNotCompleteWhereTheBaseFails) {
  EnvelopeResults results = example();
  EXPECT_TRUE(results.complete());
  results.base = step(0.0, false);
  EXPECT_FALSE(results.complete());
}

}  // namespace
}  // namespace swiftlet::evaluation
