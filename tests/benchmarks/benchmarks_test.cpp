// The benchmarks that take recordings, each on a small one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "interfaces/rgbd/rgbd_recorder.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet {
namespace {

using common::Time;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::runProgram;
using testing::HasSubstr;
using testing::Not;

TEST(Benchmarks, OfRandomFloors) {
  const ProgramEnd end = runProgram("benchmark_floors", {"--count", "1"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
}

using RecordedBenchmarks = test_support::Scratch;

/// A camera that walks through a room, slowly, and its true poses.
void record(const std::filesystem::path& folder, double frames_Hz, double reference_Hz, double reference_late_s) {
  auto recorder = interfaces::RgbdRecorder::create(folder);
  ASSERT_TRUE(recorder) << recorder.error().message.text();
  const auto pose = [](double time_s) { return mapping3d::walk(0.3 * time_s); };
  const mapping3d::TexturedRoom room;
  constexpr double kLasts_s = 2.4;
  for (int i = 0; i < kLasts_s * frames_Hz; ++i)
    ASSERT_TRUE(recorder->add(room.seen(pose(i / frames_Hz), i / frames_Hz)));
  for (double time_s = reference_late_s; time_s < kLasts_s; time_s += 1.0 / reference_Hz)
    ASSERT_TRUE(recorder->addTruth(Time::fromSeconds(time_s), pose(time_s)));
}

/// However few frames or poses of the reference come in a second, and whether they have the same stamps or not.
TEST_F(RecordedBenchmarks, CamerasBesideTheirReference) {
  record(folder_ / "same_stamps_5Hz", 5.0, 5.0, 0.0);
  record(folder_ / "other_stamps_5Hz", 5.0, 5.0, 0.07);
  record(folder_ / "fast_reference", 5.0, 100.0, 0.003);
  record(folder_ / "slow_reference", 15.0, 5.0, 0.0);
  for (const char* name : {"same_stamps_5Hz", "other_stamps_5Hz", "fast_reference", "slow_reference"}) {
    const ProgramEnd end = runProgram("benchmark_rgbd_peers", {path(name), "--only", "ours"});
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    EXPECT_THAT(end.out, HasSubstr("ours, odometry"));
    EXPECT_THAT(end.out, Not(HasSubstr(" - "))) << name;
  }
}

/// A recording of a simulated walk has what the comparison needs, and a camera that is slow is not lost.
TEST_F(RecordedBenchmarks, AWalkThroughASimulatedBuilding) {
  const ProgramEnd walk = runProgram("benchmark_rgbd_walk", {SWIFTLET_SOURCE_DIR "/trials/worlds/mit_lab.sdf",
                                                             path("walk"), "--length", "2", "--speed", "0.3"});
  ASSERT_EQ(walk.exit_code, 0) << describe(walk);
  const ProgramEnd end = runProgram("benchmark_rgbd_peers", {path("walk"), "--only", "ours"});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out, testing::ContainsRegex("ours, map with loops +0 "));
}

}  // namespace
}  // namespace swiftlet
