// A cloud of points against the surfaces that it should lie on.
#include "evaluation/cloud_metrics.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/true_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/key_pose.hpp"
#include "common/random.hpp"
#include "common/submap3d.hpp"
#include "common/world/map3d_layer.hpp"
#include "evaluation/figure_measures.hpp"
#include "evaluation/flight_recorder.hpp"
#include "small_world.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Pose3;

/// Points on the walls and the floor of the small room, seen from its left half.
Cloud truePoints(const simulation::RayCaster& rays, int count = 4000) {
  Cloud cloud;
  common::RandomStream random(3, "directions");
  while (static_cast<int>(cloud.size()) < count) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.7, 0.3)).normalized();
    const Eigen::Vector3d from(1.0, 1.5, 1.2);
    if (const simulation::Hit hit = rays.cast(from, direction, 5.0)) cloud.push_back(from + hit.distance_m * direction);
  }
  return cloud;
}

class CloudMetrics : public testing::Test {
 protected:
  simulation::RayCaster rays_{smallWorld(1.0F)};
};

TEST_F(CloudMetrics, PointsOnSurfacesHaveNoError) {
  const CloudError error = cloudError(truePoints(rays_), rays_);
  EXPECT_LT(error.median_m, 1e-5);
  EXPECT_LT(error.p95_m, 1e-5);
}

TEST_F(CloudMetrics, AnErrorIsThePerpendicularDistanceAndOutliersAreTheLast) {
  Cloud cloud = truePoints(rays_, 1000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const simulation::NearestSurface surface = rays_.nearest(cloud[i], 1.0);
    const double shift_m = i % 10 == 0 ? 0.2 : 0.03;
    const double side = surface.normal_world.dot(Eigen::Vector3d(1.0, 1.5, 1.2) - cloud[i]) > 0.0 ? 1.0 : -1.0;
    cloud[i] += side * shift_m * surface.normal_world;
  }
  const CloudError error = cloudError(cloud, rays_);
  EXPECT_NEAR(error.median_m, 0.03, 2e-3);
  EXPECT_NEAR(error.p95_m, 0.2, 0.02);
}

/// The floor of a half of the room, a tenth of which is off.
Cloud floorWithStepUp(double step_m, double apart_off_m) {
  Cloud cloud;
  const auto add = [&](double from_x, double to_x, double z, double apart_m) {
    for (double x = from_x + 0.5 * apart_m; x < to_x; x += apart_m)
      for (double y = 0.5 + 0.5 * apart_m; y < 2.5; y += apart_m) cloud.emplace_back(x, y, z);
  };
  add(0.3, 1.7, 0.01, 0.02);
  add(1.5, 1.7, step_m, apart_off_m);
  std::erase_if(cloud, [&](const Eigen::Vector3d& p) { return p.x() > 1.5 && p.z() < 0.5 * step_m; });
  return cloud;
}

TEST_F(CloudMetrics, ASurfaceCountsByItsAreaHoweverFewPointsItHas) {
  const CloudError dense = cloudError(floorWithStepUp(0.21, 0.02), rays_);
  const CloudError thinned = cloudError(floorWithStepUp(0.21, 0.08), rays_);
  EXPECT_NEAR(dense.p95_m, 0.21, 0.01);
  EXPECT_NEAR(thinned.p95_m, dense.p95_m, 1e-6);
  EXPECT_NEAR(thinned.median_m, dense.median_m, 1e-6);
}

TEST_F(CloudMetrics, FarPointsAreCapped) {
  EXPECT_EQ(cloudError({{100.0, 0.0, 50.0}}, rays_).median_m, CloudError::kLimit_m);
}

// One rigid motion is taken out, whatever the cloud's own noise; what bends the cloud stays.
TEST_F(CloudMetrics, AlignmentTakesOutARigidMotion) {
  const Pose3 off{common::quaternionFrom({0.01, -0.015, 0.03}), {0.06, -0.05, 0.04}};
  Cloud cloud = truePoints(rays_);
  common::RandomStream random(5, "noise");
  for (Eigen::Vector3d& point : cloud)
    point = off * point + 0.005 * Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian());
  EXPECT_GT(cloudError(cloud, rays_).median_m, 0.02);
  const Pose3 T = alignment(cloud, rays_);
  for (Eigen::Vector3d& point : cloud) point = T * point;
  EXPECT_LT(cloudError(cloud, rays_).median_m, 0.005);
  const Pose3 left = T * off;
  EXPECT_LT(left.position_m.norm(), 0.005);
  EXPECT_LT(left.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.003);
}

TEST_F(CloudMetrics, AnAlignmentThatTheSurfacesDoNotHoldIsRefused) {
  Cloud floor;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) floor.emplace_back(0.3 + 0.05 * column, 0.3 + 0.05 * row, 0.05);
  const Pose3 T = alignment(floor, rays_);
  EXPECT_EQ(T.position_m.norm(), 0.0) << "a floor slides";
}

common::RgbdCameraConfig camera() {
  common::RgbdCameraConfig config;
  config.range_min_m = 0.5;
  config.range_max_m = 3.5;
  return config;
}

TEST_F(CloudMetrics, SurfacesInViewAreAheadAndWithinRange) {
  const Pose3 T_world_camera{Eigen::Quaterniond::Identity(), {0.5, 1.0, 1.2}};
  EXPECT_TRUE(surfacesInView(camera(), {T_world_camera}, rays_).empty()) << "one look is a glimpse";
  const Cloud seen = surfacesInView(camera(), {T_world_camera, T_world_camera}, rays_);
  ASSERT_GT(seen.size(), 50U);
  for (const Eigen::Vector3d& place : seen) {
    EXPECT_GE(place.x() - 0.5, 0.5 - 1e-3);
    EXPECT_LE(place.x() - 0.5, 3.5 + 1e-3);
    EXPECT_LT(rays_.nearest(place, 1.0).distance_m, 1e-4);
    EXPECT_LT(std::abs(place.y() - 1.0), (place.x() - 0.5) * std::tan(0.5 * 58.1 * common::kRadPerDeg));
  }
}

TEST_F(CloudMetrics, CoverageIsTheShareOfPlacesNearAPoint) {
  const Cloud places{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {-0.01, 3, 0}};
  EXPECT_EQ(shareCovered(places, places), 1.0);
  EXPECT_EQ(shareCovered(places, {}), 0.0);
  EXPECT_EQ(shareCovered(places, {{0.05, 0.05, 0}, {1.0, 0.11, 0.0}, {0.01, 3.0, 0.05}}), 0.5);
  EXPECT_EQ(shareCovered({}, places), 1.0);
}

/// A record of a flight whose 3D map is one submap with the points.
FlightRecord recordWith(const Cloud& cloud_world_m, const Pose3& T_world_map) {
  auto points = std::make_shared<std::vector<common::SurfacePoint>>();
  for (const Eigen::Vector3d& point : cloud_world_m) {
    common::SurfacePoint one;
    one.position_m = (T_world_map.inverse() * point).cast<float>();
    points->push_back(one);
  }
  auto keys = std::make_shared<common::KeyPoses>();
  keys->keys.push_back({});
  common::Submap3d submap;
  submap.points = points;
  auto layer = std::make_shared<common::Map3dLayer>();
  layer->submaps = std::make_shared<const std::vector<common::Submap3d>>(1, submap);
  layer->keys = keys;
  FlightRecord record;
  record.T_world_map = T_world_map;
  record.map3d = layer;
  record.T_world_body_views.assign(3, {common::quaternionFrom({0.0, 0.4, 0.0}), {0.5, 1.0, 1.2}});
  return record;
}

TEST_F(CloudMetrics, TheScoreOfAFlightsMap) {
  TrueWorld world;
  world.rays = &rays_;
  const Pose3 T_world_map{Eigen::Quaterniond::Identity(), {1.0, 1.0, 0.0}};
  const auto measured = [&](const FlightRecord& record) {
    FlightScore score;
    measureMap3d(record, world, score);
    return score;
  };
  EXPECT_FALSE(measured(FlightRecord()).figure("map3d_points")) << "no camera";
  EXPECT_FALSE(measured(recordWith({}, T_world_map)).figure("map3d_points")) << "nothing mapped";
  Cloud cloud = truePoints(rays_, 40'000);
  for (Eigen::Vector3d& point : cloud) point += Eigen::Vector3d(0.03, 0.03, 0.03);
  FlightScore score = measured(recordWith(cloud, T_world_map));
  EXPECT_EQ(score["map3d_points"], 40'000.0);
  EXPECT_NEAR(score["map3d_error_median_m"].value(), 0.03, 5e-3);
  EXPECT_LT(score["map3d_aligned_median_m"].value(), 5e-3);
  EXPECT_FALSE(score["map3d_coverage"]) << "no camera, no view";
  world.rgbd_camera = camera();
  EXPECT_GT(measured(recordWith(cloud, T_world_map)).figure("map3d_coverage").value(), 0.97);
  std::erase_if(cloud, [](const Eigen::Vector3d& point) { return point.z() < 0.5; });
  EXPECT_LT(measured(recordWith(cloud, T_world_map)).figure("map3d_coverage").value(), 0.9) << "the floor is missing";
}

TEST_F(CloudMetrics, CriteriaOfTheMapAreJudged) {
  FlightScore score;
  score.mission_done = true;
  Criteria criteria;
  criteria["map3d_aligned_p95_max_m"] = 0.06;
  criteria["map3d_coverage_min"] = 0.95;
  EXPECT_EQ(missed(score, criteria).size(), 2U) << "not measured";
  score["map3d_error_median_m"] = score["map3d_aligned_p95_m"] = 0.05;
  score["map3d_coverage"] = 0.96;
  EXPECT_TRUE(missed(score, criteria).empty());
  score["map3d_coverage"] = 0.94;
  criteria["map3d_error_max_m"] = 0.04;
  EXPECT_EQ(missed(score, criteria).size(), 2U);
}

}  // namespace
}  // namespace swiftlet::evaluation
