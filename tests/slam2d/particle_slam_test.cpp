#include "perception/slam2d/particle_slam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slam2d/flight.hpp"
#include "tests/slam2d/grid_bytes.hpp"
#include "tests/slam2d/ring.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;

ParticleSlamConfig someParticles(int count, int seed = 1) {
  ParticleSlamConfig config;
  config.count = count;
  config.seed = seed;
  return config;
}

/// A flight through the flat on laser odometry alone; returns the greatest error of the scans that were taken in.
double flyFlat(ParticleSlam& slam, int scans, std::uint64_t seed) {
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, seed);
  std::vector<Pose2> truth;
  const Pose2 start = flight.start();
  for (int i = 0; i < scans && !flight.done(); ++i) {
    const auto step = flight.next();
    if (slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last).key_scan)
      truth.push_back(start.inverse() * step.truth_T_world_body);
  }
  const auto keys = slam.keyPoses();
  EXPECT_EQ(keys.size(), truth.size());
  double worst_m = 0.0;
  for (std::size_t i = 0; i < keys.size(); ++i)
    worst_m = std::max(worst_m, (keys[i].T_map_body.position_m() - truth[i].position_m()).norm());
  return worst_m;
}

TEST(ParticleSlam, MapsALoopThroughTheFlat) {
  ParticleSlam slam(someParticles(15));
  const double worst_m = flyFlat(slam, std::numeric_limits<int>::max(), 1);
  std::printf("  worst %.3f m; %d updates, %d resamplings, %d poses kept\n", worst_m,
              static_cast<int>(slam.counts().key_scans), static_cast<int>(slam.counts().resamplings),
              static_cast<int>(slam.keptPoses()));
  EXPECT_LT(worst_m, 0.04);
  EXPECT_GT(slam.counts().resamplings, 0U);
  // After a resampling the trajectories share their past.
  EXPECT_LT(slam.keptPoses(), 15 * slam.counts().key_scans * 9 / 10);
}

TEST(ParticleSlam, TheSameSeedGivesTheSameBytes) {
  ParticleSlam a(someParticles(8)), b(someParticles(8)), other(someParticles(8, 2));
  for (ParticleSlam* slam : {&a, &b, &other}) flyFlat(*slam, 150, 5);
  EXPECT_EQ(test::bytesOf(a.snapshot()), test::bytesOf(b.snapshot()));
  ASSERT_EQ(a.keyPoses().size(), b.keyPoses().size());
  for (std::size_t i = 0; i < a.keyPoses().size(); ++i)
    EXPECT_EQ(a.keyPoses()[i].T_map_body.x_m, b.keyPoses()[i].T_map_body.x_m);
  EXPECT_NE(test::bytesOf(a.snapshot()), test::bytesOf(other.snapshot()));
}

struct RingScore {
  double worst_m = 0.0, worst_odom_m = 0.0, end_m = 0.0;
};

RingScore flyRing(int particles, int seed) {
  const test::Ring ring;
  ParticleSlam slam(someParticles(particles, seed));
  std::vector<Pose2> truth;
  RingScore score;
  ring.fly(1.15, [&](const ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d& covariance,
                     const Pose2& at) {
    score.worst_odom_m = std::max(score.worst_odom_m, (T_odom_body.position_m() - at.position_m()).norm());
    if (slam.addScan(scan, T_odom_body, covariance).key_scan) truth.push_back(at);
  });
  const auto keys = slam.keyPoses();
  EXPECT_EQ(keys.size(), truth.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    score.worst_m = std::max(score.worst_m, (keys[i].T_map_body.position_m() - truth[i].position_m()).norm());
  score.end_m = (keys.back().T_map_body.position_m() - truth.back().position_m()).norm();
  std::printf("  %d particles, seed %d: worst %.3f m, end %.3f m; the odometry alone %.3f m\n", particles, seed,
              score.worst_m, score.end_m, score.worst_odom_m);
  return score;
}

TEST(ParticleSlam, ClosesALoop) {
  for (const int seed : {1, 2, 3}) {
    const RingScore score = flyRing(20, seed);
    EXPECT_LT(score.worst_m, 0.5 * score.worst_odom_m);
    EXPECT_LT(score.worst_m, 0.25);
    EXPECT_LT(score.end_m, 0.15);
  }
}

TEST(ParticleSlam, IgnoresLateEmptyAndInvalidScans) {
  ParticleSlam slam(someParticles(3));
  EXPECT_EQ(slam.anchor(), -1);
  EXPECT_TRUE(slam.keyPoses().empty());
  EXPECT_FALSE(slam.addScan({}, {}, Eigen::Matrix3d::Zero()).key_scan);  // No points: the map does not begin here.
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, 6);
  const auto step = flight.next(), next = flight.next();
  EXPECT_TRUE(slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last).key_scan);
  EXPECT_FALSE(slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last).key_scan);  // Again.
  EXPECT_FALSE(slam.addScan(next.scan, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, {}).key_scan);
  EXPECT_EQ(slam.counts().ignored_scans, 3U);
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  slam.addScan(next.scan, {5.0, 0.0, 0.0}, nan);
  EXPECT_TRUE(isFinite(slam.T_map_body()));
  EXPECT_EQ(slam.anchor(), 1);
}

/// A room in which somebody stands before a vehicle that hovers, and leaves.
class ParticlesAndAPerson : public testing::Test {
 protected:
  ParticlesAndAPerson() {
    room_.addPolyline({{-3.0, -2.0}, {4.0, -2.0}, {4.0, 2.5}, {-3.0, 2.5}}, true);
    room_.addBox(-1.0, 2.0, 0.6, 0.4);
    with_person_ = room_;
    with_person_.addBox(1.5, 0.0, 0.3, 0.4);
    laser_.rate_hz = 4.0;
    laser_.sweep_s = 0.0;
  }
  void look(const test::PlanarWorld& world, double duration_s, double tilt_rad = 0.0) {
    for (int i = 0; i < static_cast<int>(duration_s * laser_.rate_hz); ++i) {
      common::RandomStream random(5, "look", scans_);
      common::Pose3 pose = common::lifted(Pose2{}, height_m_);
      pose.rotation = common::expSO3({0.0, tilt_rad * std::sin(1.1 * i), 0.0});
      const auto at = [&](common::Time) { return pose; };
      const auto stamp = common::Time::fromSeconds(static_cast<double>(scans_++) / laser_.rate_hz);
      slam_.addScan(project(test::sweep(world, laser_, at, stamp, random), laser_, at, {}), {},
                    Eigen::Vector3d(1e-6, 1e-6, 1e-7).asDiagonal());
    }
  }
  bool isOccupiedAround(double x_m, double y_m, double half_m) {
    const common::OccupancyGrid map = slam_.snapshot();
    bool occupied = false;
    map.forEachCell([&](CellIndex cell, common::occupancy::Cell value) {
      const Eigen::Vector2d off_m = map.centerOf(cell) - Eigen::Vector2d(x_m, y_m);
      occupied |= common::occupancy::isOccupied(value) && off_m.cwiseAbs().maxCoeff() < half_m;
    });
    return occupied;
  }
  test::PlanarWorld room_, with_person_;
  common::LaserConfig laser_;
  ParticleSlam slam_{someParticles(10)};
  double height_m_ = 1.0;
  std::uint64_t scans_ = 0;
};

/// Scans are taken in every 2 s of a hover, so that it took 24 s before.
TEST_F(ParticlesAndAPerson, WhatBeamsHavePassedForTwoSecondsIsGone) {
  look(with_person_, 12.0, 0.1);
  ASSERT_TRUE(isOccupiedAround(1.4, 0.0, 0.3));
  look(room_, 1.5);
  EXPECT_TRUE(isOccupiedAround(1.4, 0.0, 0.3)) << "not at once: a return may be missing";
  look(room_, 1.0);
  EXPECT_FALSE(isOccupiedAround(1.4, 0.0, 0.3));
  EXPECT_TRUE(isOccupiedAround(4.0, 0.0, 0.1)) << "the wall behind stays";
}

TEST_F(ParticlesAndAPerson, BeamsAboveSomethingDoNotSayThatItIsGone) {
  look(with_person_, 12.0, 0.1);
  height_m_ = 1.2;
  look(room_, 4.0);
  EXPECT_TRUE(isOccupiedAround(1.4, 0.0, 0.3));
}

/// The confidence does not grow beyond its cap, however often a place was seen.
TEST(ParticleSlam, TheConfidenceOfTheBestMapStaysCapped) {
  ParticleSlam slam(someParticles(5));
  flyFlat(slam, 200, 3);
  const int cap = GridDrawingConfig::max_steps;
  int known = 0;
  slam.snapshot().forEachCell([&](CellIndex, common::occupancy::Cell value) {
    if (common::occupancy::isUnknown(value)) return;
    ++known;
    EXPECT_LE(std::abs(static_cast<int>(value)), cap);
  });
  EXPECT_GT(known, 1000);
}

}  // namespace
}  // namespace swiftlet::perception
