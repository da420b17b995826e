// The methods of 2D SLAM behind their common interface: each maps the same flight, and its counters show that it did
// the work.
#include "perception/slam2d/slam_method.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/config.hpp"
#include "evaluation/relations.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "tests/slam2d/flight.hpp"
#include "tests/slam2d/grid_bytes.hpp"
#include "tests/slam2d/tracked_path.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;

/// The configuration with the method of that name, as in a profile.
SlamMethodConfig configOf(const std::string& method) {
  SlamMethodConfig config;
  common::config::YamlReader::fromText("{method: " + method + "}", method).read(config);
  config.particles.count = 10;
  return config;
}

class EachSlamMethod : public testing::TestWithParam<std::string> {
 protected:
  /// The chosen method matched scans, and no other did.
  void expectAtWork(const SlamCounts& counts, std::uint64_t least_matches) const {
    const std::string& method = GetParam();
    const auto expect = [&](const std::string& name, std::uint64_t matches) {
      if (name == method)
        EXPECT_GE(matches, least_matches) << name;
      else
        EXPECT_EQ(matches, 0U) << name;
    };
    expect("graph", counts.graph_matches);
    expect("particles", counts.particle_matches);
    expect("scan_to_map", counts.map_matches);
  }
};
INSTANTIATE_TEST_SUITE_P(, EachSlamMethod, testing::Values("graph", "particles", "scan_to_map"),
                         [](const auto& method) { return method.param; });

struct Flown {
  double rms_m = 0.0, max_m = 0.0;
  double wall_median_m = 0.0, wall_p90_m = 0.0;
};

/// Flies once through the flat, at most `scans` scans, and calls `each(step, update)` after each scan.
template <typename Each>
Flown flyFlat(PlanarSlam& slam, std::uint64_t seed, int scans, Each&& each) {
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, seed);
  const Pose2 T_world_map = flight.start();
  Flown flown;
  int flown_scans = 0;
  for (; flown_scans < scans && !flight.done(); ++flown_scans) {
    const auto step = flight.next();
    const SlamUpdate update = slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
    if (const auto task = slam.takeTask()) slam.apply(run(*task));
    EXPECT_LT((update.T_map_body.position_m() - (slam.T_map_odom() * step.T_odom_body).position_m()).norm(), 0.05);
    const double error_m =
        ((T_world_map * update.T_map_body).position_m() - step.truth_T_world_body.position_m()).norm();
    flown.rms_m += error_m * error_m;
    flown.max_m = std::max(flown.max_m, error_m);
    each(step, update);
  }
  flown.rms_m = std::sqrt(flown.rms_m / flown_scans);
  std::vector<double> walls;
  const common::OccupancyGrid map = slam.snapshot();
  map.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    if (common::occupancy::isOccupied(value))
      walls.push_back(flight.world().distanceToWall(T_world_map * map.centerOf(c)));
  });
  std::sort(walls.begin(), walls.end());
  if (walls.empty()) return flown;
  flown.wall_median_m = walls[walls.size() / 2];
  flown.wall_p90_m = walls[walls.size() * 9 / 10];
  return flown;
}

constexpr int kToTheEnd = std::numeric_limits<int>::max();
constexpr auto kUnreported = [](const auto&, const auto&) {};

TEST_P(EachSlamMethod, MapsTheFlat) {
  const auto slam = makeSlam(configOf(GetParam()));
  const Flown flown = flyFlat(*slam, 1, kToTheEnd, kUnreported);
  const SlamCounts& counts = slam->counts();
  std::printf("  %-11s rms %.1f mm, max %.1f; walls median %.1f, p90 %.1f mm; %d key scans, %d rejected matches\n",
              GetParam().c_str(), 1e3 * flown.rms_m, 1e3 * flown.max_m, 1e3 * flown.wall_median_m,
              1e3 * flown.wall_p90_m, static_cast<int>(counts.key_scans), static_cast<int>(counts.local_failures));
  EXPECT_LT(flown.rms_m, 0.03);
  EXPECT_LT(flown.max_m, 0.06);
  EXPECT_LT(flown.wall_median_m, 0.03);
  EXPECT_LT(flown.wall_p90_m, 0.06);
  expectAtWork(counts, counts.key_scans / 2);
  EXPECT_GT(counts.key_scans, 30U);
  EXPECT_EQ(slam->keyPoses().size(), counts.key_scans);
  EXPECT_EQ(slam->edges().empty(), GetParam() != "graph");
}

TEST_P(EachSlamMethod, GivesTheSameBytesTwice) {
  const auto one = makeSlam(configOf(GetParam())), other = makeSlam(configOf(GetParam()));
  for (PlanarSlam* slam : {one.get(), other.get()}) flyFlat(*slam, 5, 150, kUnreported);
  EXPECT_EQ(test::bytesOf(one->snapshot()), test::bytesOf(other->snapshot()));
  const auto keys = one->keyPoses(), others = other->keyPoses();
  ASSERT_EQ(keys.size(), others.size());
  for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(keys[i].T_map_body.x_m, others[i].T_map_body.x_m);
  EXPECT_EQ(one->T_map_odom().yaw_rad, other->T_map_odom().yaw_rad);
}

TEST_P(EachSlamMethod, PlacesTheLastScanRelativeToAKeyScan) {
  const auto slam = makeSlam(configOf(GetParam()));
  EXPECT_EQ(slam->anchor(), -1);
  EXPECT_TRUE(slam->keyPoses().empty());
  flyFlat(*slam, 2, 120, [&](const auto&, const SlamUpdate& update) {
    const Pose2 key = slam->keyPoses().at(static_cast<std::size_t>(slam->anchor())).T_map_body;
    EXPECT_LT(((key * slam->T_anchor_body()).position_m() - update.T_map_body.position_m()).norm(), 1e-9);
  });
}

TEST_P(EachSlamMethod, IgnoresLateEmptyAndInvalidScans) {
  const auto slam = makeSlam(configOf(GetParam()));
  EXPECT_FALSE(slam->addScan({}, {}, Eigen::Matrix3d::Zero()).key_scan);  // No points: the map does not begin here.
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, 6);
  const auto step = flight.next(), next = flight.next();
  EXPECT_TRUE(slam->addScan(step.scan, step.T_odom_body, step.covariance_since_last).key_scan);
  EXPECT_FALSE(slam->addScan(step.scan, step.T_odom_body, step.covariance_since_last).drawn);  // Again.
  EXPECT_FALSE(slam->addScan(next.scan, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, {}).drawn);
  EXPECT_EQ(slam->counts().ignored_scans, 3U);
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(isFinite(slam->addScan(next.scan, {5.0, 0.0, 0.0}, nan).T_map_body));
  EXPECT_TRUE(isFinite(slam->T_map_odom()));
}

/// The first minutes of a log of a robot on wheels, with its odometry.
TEST_P(EachSlamMethod, MapsASliceOfIntel) {
  constexpr int kScans = 1500;
  const auto file = test_support::dataSet("01-laser-slam/intel/intel.clf.bz2");
  const auto relations = test_support::dataSet("01-laser-slam/intel/intel.relations.gz");
  if (!file || !relations) return;
  LaserSlamConfig config = test_support::laserLogSlam();
  config.slam.method = configOf(GetParam()).method;
  config.slam.particles.count = 10;
  LaserSlam slam(config);
  test::TrackedPath path(slam);
  const auto log = interfaces::openLaserLog(*file);
  for (int i = 0; i < kScans; ++i) {
    const auto logged = log->next();
    path.add(logged->scan.stamps.measured, {logged->scan, logged->T_robot_laser, logged->T_odom_robot});
  }
  const auto errors = evaluation::relationErrors(path.finish(), interfaces::readRelations(*relations));
  std::printf("  %-11s %d relations: %.4f m, %.3f deg; %d key scans\n", GetParam().c_str(),
              static_cast<int>(errors.translation_m.count), errors.translation_m.mean,
              errors.rotation_rad.mean / common::kRadPerDeg, static_cast<int>(slam.keyScans()));
  EXPECT_GT(errors.translation_m.count, 100U);
  EXPECT_LT(errors.translation_m.mean, 0.0229);
  EXPECT_LT(errors.rotation_rad.mean / common::kRadPerDeg, 0.453);
  EXPECT_EQ(slam.slam().method(), config.slam.method);
  expectAtWork(slam.slam().counts(), slam.keyScans() / 2);
}

}  // namespace
}  // namespace swiftlet::perception
