// Poses of other sensors beside the track: bad ones must not spoil it, good ones carry it where nothing is seen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/random.hpp"
#include "mapping3d/odometry/recorded_seeds.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

constexpr double kSeeds_Hz = 10.0;

struct SeedErrors {
  double sigma_m = 0.0;    ///< Of x and y.
  double sigma_rad = 0.0;  ///< Of yaw.
  double lateness_s = 0.0;
};

common::Trajectory madeSeeds(const SeedErrors& errors, std::uint64_t seed, double length_s) {
  common::Trajectory seeds;
  for (int i = -10; i / kSeeds_Hz < length_s + 1.0; ++i) {
    common::RandomStream random(seed, "seeds", static_cast<std::uint64_t>(i + 10));
    Pose3 pose = walk(i / kSeeds_Hz);
    pose.position_m.x() += random.gaussian(errors.sigma_m);
    pose.position_m.y() += random.gaussian(errors.sigma_m);
    pose.rotation = common::quaternionFrom({0.0, 0.0, random.gaussian(errors.sigma_rad)}) * pose.rotation;
    seeds.push_back({common::Time::fromSeconds(100.0 + i / kSeeds_Hz + errors.lateness_s), pose});
  }
  return seeds;
}

/// Root mean square over the frames of the motion since the first one.
struct Errors {
  double track_m = 0.0, seed_m = 0.0;
  int lost = 0;
};

Errors trackWith(RecordedSeeds& seeds, const common::Trajectory& poses, int frames) {
  const TexturedRoom room;
  const RecordedSeeds as_given(poses);
  RgbdOdometry odometry({});
  Errors errors;
  Pose3 first;
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    const auto stamp = common::Time::fromSeconds(100.0 + time_s);
    const RgbdPose pose = odometry.process(room.seen(walk(time_s), 100.0 + time_s), seeds.at(stamp));
    seeds.compare(pose);
    if (i == 0) first = pose.T_map_camera * walk(0.0).inverse();
    if (!pose.isTracked()) ++errors.lost;
    errors.track_m += (pose.T_map_camera.position_m - (first * walk(time_s)).position_m).squaredNorm() / frames;
    if (const auto given = as_given.at(stamp))
      errors.seed_m += (given->T_map_camera.position_m - walk(time_s).position_m).squaredNorm() / frames;
  }
  errors.track_m = std::sqrt(errors.track_m);
  errors.seed_m = std::sqrt(errors.seed_m);
  return errors;
}

TEST(RecordedSeeds, NoisyAndLateTheyDoNotSpoilTheTrack) {
  RecordedSeeds none({});
  const double without_m = trackWith(none, {}, 75).track_m;
  for (const std::uint64_t seed : {1, 2}) {
    const common::Trajectory poses = madeSeeds({0.03, common::kRadPerDeg, 0.1}, seed, 5.0);
    RecordedSeeds seeds(poses);
    const Errors with = trackWith(seeds, poses, 75);
    EXPECT_EQ(with.lost, 0);
    EXPECT_GT(with.seed_m, 0.03);
    EXPECT_LT(with.track_m, 1.1 * without_m + 0.0005) << seed;
    EXPECT_LT(with.track_m, 0.5 * with.seed_m) << seed;
    EXPECT_NEAR(seeds.lateness_s(), 0.1, 0.05) << seed;
    const auto covariance = seeds.at(common::Time::fromSeconds(104.0))->rate_covariance;
    ASSERT_TRUE(covariance);
    // x, y and yaw are noisy; z, roll and pitch are not.
    EXPECT_GT((*covariance)(0, 0), 16.0 * (*covariance)(2, 2)) << seed;
    EXPECT_GT((*covariance)(1, 1), 16.0 * (*covariance)(2, 2)) << seed;
    EXPECT_GT((*covariance)(5, 5), 9.0 * (*covariance)(3, 3)) << seed;
  }
}

TEST(RecordedSeeds, ThatAreLateAreReadLater) {
  for (const double lateness_s : {0.0, 0.15, -0.08}) {
    const common::Trajectory poses = madeSeeds({0.0, 0.0, lateness_s}, 1, 3.0);
    RecordedSeeds seeds(poses);
    trackWith(seeds, poses, 45);
    EXPECT_NEAR(seeds.lateness_s(), lateness_s, 0.011);
  }
}

TEST(RecordedSeeds, ThatContradictTheTrackAreTold) {
  const auto disagreement = [](const auto& change) {
    common::Trajectory poses = madeSeeds({0.03, common::kRadPerDeg, 0.1}, 1, 5.0);
    for (common::StampedPose& at : poses) change(at.pose);
    RecordedSeeds seeds(poses);
    trackWith(seeds, poses, 60);
    return seeds.disagreement();
  };
  const auto good = disagreement([](Pose3&) {});
  ASSERT_TRUE(good);
  EXPECT_FALSE(good->isContradiction()) << good->error_m << " m, " << good->error_rad << " rad";
  const auto millimetres = disagreement([](Pose3& pose) { pose.position_m *= 1000.0; });
  const auto w_first = disagreement([](Pose3& pose) {
    const Eigen::Quaterniond q = pose.rotation;
    pose.rotation = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  });
  const auto constant = disagreement([](Pose3& pose) { pose = Pose3{}; });
  for (const auto& bad : {millimetres, w_first, constant}) {
    ASSERT_TRUE(bad);
    EXPECT_TRUE(bad->isContradiction()) << bad->error_m << " m, " << bad->error_rad << " rad; " << bad->motion_m
                                        << " m, " << bad->motion_rad << " rad";
  }
  EXPECT_FALSE(RecordedSeeds({}).disagreement());
}

/// After two seconds only one frame in more than a second comes, too few to continue the track by its own motion. What
/// is then found again by what it looks like does not count.
TEST(RecordedSeeds, ThatAreGoodCarryItAcrossTurnsThatAreNotSeen) {
  const TexturedRoom room;
  const auto tracked_on = [&](RecordedSeeds seeds, double gap_s) {
    RgbdOdometry odometry({});
    int tracked = 0;
    for (int i = 0; i < 36; ++i) {
      const double time_s = i < 30 ? i / kWalkFrames_Hz : 2.0 + gap_s * (i - 29);
      const common::RgbdFrame frame = room.seen(walk(time_s), 100.0 + time_s);
      const auto seed = seeds.at(frame.stamps.measured);
      const RgbdPose pose = odometry.process(frame, seed);
      seeds.compare(pose);
      if (i < 30 || pose.state != TrackState::kTracked) continue;
      ++tracked;
      if (seed) {
        EXPECT_LT((pose.T_map_camera.position_m - walk(time_s).position_m).norm(), 0.03);
      }
    }
    return tracked;
  };
  for (const double gap_s : {1.1, 1.5}) {
    EXPECT_EQ(tracked_on(RecordedSeeds(madeSeeds({0.005, 0.002, 0.0}, 3, 12.0)), gap_s), 6) << gap_s;
    EXPECT_LT(tracked_on(RecordedSeeds({}), gap_s), 4) << gap_s;
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
