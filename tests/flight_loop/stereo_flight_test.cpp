// One seed of the flight of Tomic 2012, Fig. 7 and 9: by laser and stereo camera out of a house and round it.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "evaluation/trial.hpp"
#include "simulated_flight/trial_flight.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::simulated_flight {
namespace {

TEST(StereoFlight, OutOfTheHouseByItsWindowAndRoundIt) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swiftlet_stereo_flight_" + std::to_string(::getpid()));
  std::vector<evaluation::TrialConfig> trials{
      evaluation::readTrial(SWIFTLET_SOURCE_DIR "/trials/papers/dlr_window_stereo.yaml").byCondition().front()};
  prepare(trials);
  trials[0].scenario.nature =
      std::make_shared<const simulation::Nature>(simulation::Nature::load(trials[0].natures.front()));
  const auto scores = flyScored(trials[0], setupOf(trials[0], {}, 1, folder / "flight"), {});
  ASSERT_EQ(scores.size(), 1U);
  for (const evaluation::EventOrderScore& order : scores[0].event_orders)
    for (const evaluation::PlacedEvent& came : order.came)
      std::printf("%6.2f s  %-30s (%.2f, %.2f, %.2f) m\n", came.stamp.seconds(), came.text.c_str(),
                  came.place_map_m.x(), came.place_map_m.y(), came.place_map_m.z());
  ASSERT_EQ(scores[0].event_orders.size(), 1U);
  // The whole order of the paper comes in one of five flights (docs/decisions/fusion.md#120).
  EXPECT_GE(scores[0].event_orders[0].came.size(), 4U);
  EXPECT_TRUE(scores[0].mission_done) << scores[0].outcome;
  EXPECT_EQ(scores[0].collisions, 0);
  // Held-back seeds have up to 1.1 % (docs/decisions/fusion.md#120).
  EXPECT_LT(scores[0].figure("end_error_share").value_or(1.0), 0.015);
  // The paper's 20 cm, and 10 cm in the window, as the trial asks for.
  for (const evaluation::PhaseScore& phase : scores[0].phases)
    EXPECT_LT(phase.figure("control_error_max_m").value_or(1.0), phase.name == "window" ? 0.1 : 0.2) << phase.name;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace swiftlet::simulated_flight
