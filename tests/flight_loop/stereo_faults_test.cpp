// One seed of the flight whose stereo camera sends bad pairs: each kind is told by its reason, and the flight goes on.
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

TEST(StereoFaults, BadPairsAreLeftOutWithTheirReasonAndTheFlightGoesOn) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swiftlet_stereo_faults_" + std::to_string(::getpid()));
  std::vector<evaluation::TrialConfig> trials{
      evaluation::readTrial(SWIFTLET_SOURCE_DIR "/trials/faults/stereo_pictures.yaml").byCondition().front()};
  prepare(trials);
  const auto scores = flyScored(trials[0], setupOf(trials[0], {}, 1, folder / "flight"), {});
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_TRUE(scores[0].passed()) << scores[0].outcome;
  ASSERT_EQ(scores[0].event_orders.size(), 1U);
  for (const std::string& missed : scores[0].event_orders[0].missed()) ADD_FAILURE() << missed;
  EXPECT_EQ(scores[0].collisions, 0);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace swiftlet::simulated_flight
