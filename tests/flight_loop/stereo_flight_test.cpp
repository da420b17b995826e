// One seed of the flight of Tomic 2012, Fig. 7 and 9: by laser and stereo camera out of a house and round it.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "evaluation/trial.hpp"
#include "simulated_flight/trial_flight.hpp"

namespace swiftlet::simulated_flight {
namespace {

TEST(StereoFlight, OutOfTheHouseByItsWindowAndRoundIt) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swiftlet_stereo_flight_" + std::to_string(::getpid()));
  std::vector<evaluation::TrialConfig> trials{
      evaluation::readTrial(SWIFTLET_SOURCE_DIR "/trials/papers/dlr_window_stereo.yaml").byCondition().front()};
  prepare(trials);
  const auto scores = flyScored(trials[0], setupOf(trials[0], {}, 1, folder / "flight"), {});
  ASSERT_EQ(scores.size(), 1U);
  for (const evaluation::EventOrderScore& order : scores[0].event_orders)
    for (const evaluation::PlacedEvent& came : order.came)
      std::printf("%6.2f s  %-30s (%.2f, %.2f, %.2f) m\n", came.stamp.seconds(), came.text.c_str(),
                  came.place_map_m.x(), came.place_map_m.y(), came.place_map_m.z());
  for (const std::string& failure : scores[0].failures) ADD_FAILURE() << failure;
  EXPECT_TRUE(scores[0].passed()) << scores[0].outcome;
  EXPECT_LT(scores[0].figure("end_error_share").value_or(1.0), 0.02);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace swiftlet::simulated_flight
