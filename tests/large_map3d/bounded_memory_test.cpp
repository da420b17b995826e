// The 3D map's memory does not grow with the length of a flight: a corridor without end, by simulated sweeps and key
// frames.
#include <malloc.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "autonomy/estimation/map3d_publisher.hpp"
#include "common/random.hpp"
#include "mapping3d/model/submap_store.hpp"
#include "mapping3d/odometry/key_frame_map.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;
using Eigen::Vector3d;

constexpr double kStep_m = 0.5;

double heap_MB() { return 1e-6 * static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd); }

/// A round tunnel with a radius of 1.5 m. Each step makes a key scan, a sweep and a key frame.
class Tunnel {
 public:
  Tunnel(const mapping3d::SubmapConfig& submaps, int key_frames)
      : store_(submaps, voxels_, noise_), key_frames_(key_frames), publisher_(voxels_.resolution_m, *jobs_) {}

  void fly(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }

  /// Of all submaps.
  std::size_t points() {
    std::size_t count = 0;
    for (const common::Submap3d& submap : store_.snapshot()) count += submap.points->size();
    return count;
  }

 private:
  void step() {
    const int scan = steps_++;
    const Time now = Time::fromSeconds(scan);
    keys_.keys.push_back({now, {kStep_m * scan, 0.0, 0.0}});
    ++keys_.version;
    store_.draw(sweep(scan), keys_);
    key_frames_.add(keyFrame(scan), {{Eigen::Quaterniond::Identity(), {kStep_m * scan, 0.0, 1.5}}, scan, 0});
    if (scan % 50 != 0) return;
    const auto keys = std::make_shared<const common::KeyPoses>(keys_);
    publisher_.setSubmaps(store_.snapshot());
    publisher_.fuse(keys, now);
    jobs_->deliverDue(now + common::Duration::fromSeconds(5));
    publisher_.layer(keys);
  }

  static mapping3d::PlacedSweep sweep(int scan) {
    mapping3d::PlacedSweep sweep;
    sweep.scan = scan;
    const Vector3d origin_m(0.0, 0.0, 1.5);
    for (int i = 0; i < 60; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / 60.0;
      const double along_m = kStep_m * (i % 7) / 7.0;
      sweep.rays_scan.push_back(
          {origin_m, origin_m + Vector3d(along_m, 1.5 * std::cos(angle_rad), 1.5 * std::sin(angle_rad))});
    }
    return sweep;
  }

  static std::shared_ptr<const mapping3d::KeyFrame> keyFrame(int scan) {
    common::RandomStream random(1, "key frame", static_cast<std::uint64_t>(scan));
    auto key = std::make_shared<mapping3d::KeyFrame>();
    key->stamp = Time::fromSeconds(scan);
    key->levels.assign(2, std::vector<mapping3d::ReferencePoint>(500));
    key->described.resize(100);
    for (mapping3d::DescribedPoint& point : key->described)
      for (std::uint64_t& bits : point.descriptor.bits)
        bits = static_cast<std::uint64_t>(random.uniform(0.0, 1.0) * 9e15) * 2654435761U;
    return key;
  }

  mapping3d::VoxelConfig voxels_;
  vision::DepthNoiseConfig noise_;
  common::KeyPoses keys_;
  mapping3d::SubmapStore store_;
  mapping3d::KeyFrameMap key_frames_;
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  Map3dPublisher publisher_;
  int steps_ = 0;
};

struct Bound {
  std::string name;
  mapping3d::SubmapConfig submaps;
};

std::vector<Bound> bounds() {
  Bound points{"points", {}}, submaps{"submaps", {}}, blocks{"blocks", {}};
  points.submaps.points_max = 4'000;
  points.submaps.submaps_max = 30;  // Voxels are not thinned.
  submaps.submaps.submaps_max = 8;
  blocks.submaps.blocks_max = 400;
  return {points, submaps, blocks};
}

class Bounded : public testing::TestWithParam<Bound> {};

/// How much a flight adds to the memory that another of the same length has filled.
double growth_MB(Tunnel& tunnel, int steps) {
  const double before_MB = heap_MB();
  tunnel.fly(steps);
  return heap_MB() - before_MB;
}

TEST_P(Bounded, BeyondItTheMapGrowsNoMore) {
  Tunnel tunnel(GetParam().submaps, 40);
  const double first_MB = growth_MB(tunnel, 250);
  const double second_MB = growth_MB(tunnel, 250);
  EXPECT_GT(first_MB, 1.0);
  EXPECT_LT(second_MB, 0.1 * first_MB);
  EXPECT_LT(tunnel.points(), GetParam().submaps.points_max + 1'000U) << "and what the growing submap has";
}

INSTANTIATE_TEST_SUITE_P(Each, Bounded, testing::ValuesIn(bounds()),
                         [](const auto& bound) { return bound.param.name; });

TEST(Unbounded, TheMapGrowsWithTheFlight) {
  Tunnel submaps(mapping3d::SubmapConfig(), 40);
  const double first_MB = growth_MB(submaps, 250);
  const double second_MB = growth_MB(submaps, 250);
  EXPECT_GT(second_MB, 0.3 * first_MB) << "the first 40 key frames are part of the first growth";
  mapping3d::SubmapConfig few;
  few.submaps_max = 8;
  Tunnel key_frames(few, 10'000);
  key_frames.fly(250);
  EXPECT_GT(growth_MB(key_frames, 250), 5.0) << "250 key frames";
}

}  // namespace
}  // namespace swiftlet::autonomy
