// The parts of localization, each against the slow and obvious way.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "perception/localization/beam_sums.hpp"
#include "perception/localization/global_search.hpp"
#include "perception/localization/kld_sampling.hpp"
#include "perception/localization/local_map.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/localization/odometer.hpp"
#include "perception/localization/particle_filter.hpp"
#include "perception/localization/place_posterior.hpp"
#include "perception/localization/scan_support.hpp"
#include "tests/localization/buildings.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

std::shared_ptr<const MapField> fieldOf(const test::Building& building) {
  return std::make_shared<const MapField>(test::mapOf(building), MapFieldConfig{});
}

std::vector<Eigen::Vector2f> pointsAt(const test::Building& building, const Pose2& pose, std::uint64_t seed = 1) {
  common::RandomStream random(seed, "points");
  return test::levelScan(building.world, pose, common::Time{}, random).points_level_m;
}

TEST(MapField, DistancesAreThoseToTheNearestWall) {
  const test::Building building = test::offices(3);
  const common::OccupancyGrid map = test::mapOf(building);
  const MapField field(map, MapFieldConfig{});
  std::vector<Eigen::Vector2d> walls;
  map.forEachCell([&](common::CellIndex c, common::occupancy::Cell cell) {
    if (common::occupancy::isOccupied(cell)) walls.push_back(map.centerOf(c));
  });
  common::RandomStream random(1, "places");
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d at(random.uniform(0.5, 17.0), random.uniform(-4.0, 4.0));
    const Eigen::Vector2d center = map.centerOf(map.cellAt(at));
    double nearest = MapField::kMaxDistance_m;
    for (const Eigen::Vector2d& wall : walls) nearest = std::min(nearest, (wall - center).norm());
    EXPECT_NEAR(field.at(at).wall_distance_m, nearest, 0.0051);
    EXPECT_EQ(field.at(at).occupied, common::occupancy::isOccupied(map.at(map.cellAt(at))));
    EXPECT_EQ(field.at(at).known, !common::occupancy::isUnknown(map.at(map.cellAt(at))));
  }
  EXPECT_FALSE(field.at({1e6, 0.0}).known);
  EXPECT_FALSE(field.at({NAN, 0.0}).known);
}

TEST(MapField, CountsTheFreeCellsRowByRow) {
  const common::OccupancyGrid map = test::mapOf(test::offices(3));
  const MapField field(map, MapFieldConfig{});
  const common::CellRect known = common::knownExtent(map);
  std::size_t n = 0;
  for (int y = known.begin.y; y < known.end.y; ++y)
    for (int x = known.begin.x; x < known.end.x; ++x)
      if (common::occupancy::isFree(map.at({x, y}))) {
        ASSERT_EQ(field.freeCell_m(n++), map.centerOf({x, y}));
      }
  EXPECT_EQ(field.freeCells(), n);
}

TEST(MapField, RaysEndWhereTheBeamsOfTheWorldDo) {
  const test::Building building = test::offices(4);
  const auto field = fieldOf(building);
  const test::Walks walks(building);
  common::RandomStream random(2, "rays");
  int shorter = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d from = walks.somewhere(random);
    const double angle = random.uniform(-3.1, 3.1);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const double truth = building.world.cast({from.x(), from.y(), 1.0}, {direction.x(), direction.y(), 0.0});
    const double found = field->rayLength_m(from, from + 40.0 * direction);
    // A ray that grazes a wall meets its cell earlier; it must never pass one.
    EXPECT_LE(found, truth + 0.15) << from.transpose() << " " << angle;
    shorter += found < truth - 0.15 ? 1 : 0;
    EXPECT_EQ(field->rayLength_m(from, from + 1e29 * direction), found) << "a length that no laser has";
  }
  EXPECT_LE(shorter, 20);
}

TEST(BeamSums, EveryInstructionSetGivesTheBitsOfTheScalarOne) {
  const auto field = fieldOf(test::offices(5));
  common::RandomStream random(3, "sums");
  for (const std::size_t count : {1U, 7U, 16U, 100U}) {
    std::vector<float> x, y, cosine, sine, beams_x, beams_y;
    for (std::size_t i = 0; i < count; ++i) {
      x.push_back(static_cast<float>(random.uniform(-200.0, 900.0)));
      y.push_back(static_cast<float>(random.uniform(-200.0, 900.0)));
      const double yaw = random.uniform(-3.1, 3.1);
      cosine.push_back(static_cast<float>(std::cos(yaw)));
      sine.push_back(static_cast<float>(std::sin(yaw)));
    }
    if (count > 6) {
      x[2] = std::numeric_limits<float>::quiet_NaN();
      y[3] = std::numeric_limits<float>::infinity();
      x[4] = -1e30F;
    }
    for (int k = 0; k < 61; ++k) {
      beams_x.push_back(static_cast<float>(random.uniform(-300.0, 300.0)));
      beams_y.push_back(static_cast<float>(random.uniform(-300.0, 300.0)));
    }
    std::vector<std::int32_t> expected(count), sums(count);
    sumBeams(Instructions::kScalar, field->view(), {x, y, cosine, sine}, {beams_x, beams_y}, expected);
    for (const Instructions instructions : {Instructions::kSse41, Instructions::kAvx2}) {
      if (!isAvailable(instructions)) continue;
      sumBeams(instructions, field->view(), {x, y, cosine, sine}, {beams_x, beams_y}, sums);
      EXPECT_EQ(sums, expected) << toString(instructions) << " " << count;
    }
  }
}

TEST(CosinesAndSines, AreThoseOfTheLibrary) {
  std::vector<float> angles, cosines, sines;
  for (int i = -6280; i <= 6280; ++i) angles.push_back(0.001F * static_cast<float>(i));
  cosines.resize(angles.size());
  sines.resize(angles.size());
  cosinesAndSines(angles, cosines, sines);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    ASSERT_NEAR(cosines[i], std::cos(static_cast<double>(angles[i])), 1e-6) << angles[i];
    ASSERT_NEAR(sines[i], std::sin(static_cast<double>(angles[i])), 1e-6) << angles[i];
  }
}

TEST(KldSampling, NeedsWhatFoxsTableSays) {
  // Equation 7 of Fox 2003 at 100 bins, error 0.05, 99 %: chi-square quantile 134.6 over 2 epsilon.
  EXPECT_NEAR(kldSampleSize(100, 0.05, 2.326), 134.64 / 0.1, 3.0);
  EXPECT_EQ(kldSampleSize(1, 0.05, 2.326), 1.0);
}

TEST(KldSampling, WhatIsNoPlaceFallsIntoABinAsWell) {
  PoseBins bins(0.25, 0.17);
  for (const double value : {0.0, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) bins.add(value, 0.0, 0.0);
  bins.add(0.3, 0.0, 0.0);
  bins.add(-0.1, 0.0, 0.0);
  EXPECT_EQ(bins.occupied(), 5U);
}

TEST(ParticleFilter, DrawsAsManyParticlesAsTheBeliefNeeds) {
  const test::Building building = test::offices(6);
  ParticleFilter filter(fieldOf(building), ParticleFilterConfig{}, 1);
  filter.spreadOverFreeSpace();
  EXPECT_EQ(filter.size(), 5000U);
  const PoseHypothesis here{{5.0, 0.0, 0.3}, Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal(), 1.0};
  filter.spreadAround(std::span(&here, 1));
  filter.resample();
  EXPECT_LE(filter.size(), 700U);
  EXPECT_GE(filter.size(), 500U);
}

/// The mean and spread of resampled particles are those of the weighted ones.
TEST(ParticleFilter, DrawingAnewKeepsTheBelief) {
  const test::Building building = test::offices(7);
  for (const bool adaptive : {false, true}) {
    ParticleFilterConfig config;
    config.adaptive = adaptive;
    ParticleFilter filter(fieldOf(building), config, 2);
    const PoseHypothesis here{{5.0, 0.0, 3.1}, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal(), 1.0};
    filter.spreadAround(std::span(&here, 1));
    filter.weigh(pointsAt(building, {5.05, 0.1, 3.12}));
    const auto before = filter.estimate();
    filter.resample();
    const auto after = filter.estimate();
    EXPECT_NEAR((before.T_grid_body.position_m() - after.T_grid_body.position_m()).norm(), 0.0, 0.01);
    EXPECT_NEAR(common::wrapAngle(before.T_grid_body.yaw_rad - after.T_grid_body.yaw_rad), 0.0, 0.005);
    EXPECT_NEAR(std::sqrt(after.covariance(0, 0) / before.covariance(0, 0)), 1.0, 0.15);
  }
}

TEST(ParticleFilter, MovesAsToldWithTheNoiseTold) {
  ParticleFilter filter(fieldOf(test::offices(8)), ParticleFilterConfig{}, 3);
  const PoseHypothesis here{{5.0, 0.0, 0.5}, Eigen::Matrix3d::Zero(), 1.0};
  filter.spreadAround(std::span(&here, 1));
  Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.0025, 0.0004).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = 0.002;
  filter.move({0.4, 0.1, 0.2}, covariance);
  const Pose2 expected = Pose2{5.0, 0.0, 0.5} * Pose2{0.4, 0.1, 0.2};
  const auto estimate = filter.estimate();
  EXPECT_NEAR(estimate.T_grid_body.x_m, expected.x_m, 0.005);
  EXPECT_NEAR(estimate.T_grid_body.y_m, expected.y_m, 0.005);
  EXPECT_NEAR(estimate.T_grid_body.yaw_rad, expected.yaw_rad, 0.001);
  EXPECT_LT((estimate.covariance - common::turned(covariance, 0.5)).cwiseAbs().maxCoeff(), 6e-4);
}

TEST(ParticleFilter, TheSameSeedGivesTheSameParticlesOnEveryInstructionSet) {
  const test::Building building = test::offices(9);
  const auto field = fieldOf(building);
  std::vector<Pose2> first;
  for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
    if (!isAvailable(instructions)) continue;
    ParticleFilter filter(field, ParticleFilterConfig{}, 4, instructions);
    filter.spreadOverFreeSpace();
    for (int i = 0; i < 5; ++i) {
      filter.move({0.2, 0.0, 0.05}, Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal());
      filter.weigh(pointsAt(building, {4.0 + 0.2 * i, 0.0, 0.05 * i}));
      filter.resample();
    }
    std::vector<Pose2> all;
    for (std::size_t i = 0; i < filter.size(); ++i) all.push_back(filter.particle(i));
    if (first.empty()) first = all;
    ASSERT_EQ(first.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(first[i].x_m, all[i].x_m);
      ASSERT_EQ(first[i].yaw_rad, all[i].yaw_rad);
    }
  }
}

struct GridPose {
  int score = 0, direction = 0, row = 0, column = 0;
  auto operator<=>(const GridPose&) const = default;
};

/// Every pose of the search's own grid, one by one: those that fit and are distinct from all that fit better. Points
/// lie within 12 m.
std::vector<FittingPlace> exhaustively(const MapField& map, const GlobalSearchConfig& config, double margin,
                                       const std::vector<Eigen::Vector2f>& points) {
  const auto columns = static_cast<int>(std::ceil((map.high_m() - map.low_m()).x() / config.cell_m));
  const auto rows = static_cast<int>(std::ceil((map.high_m() - map.low_m()).y() / config.cell_m));
  const int border = static_cast<int>(13.0 / config.cell_m), width = columns + 2 * border;
  const auto centerOf = [&](int column, int row) -> Eigen::Vector2d {
    return map.low_m() + Eigen::Vector2d(column + 0.5, row + 0.5) * config.cell_m;
  };
  const MapFieldConfig& field = map.config();
  std::vector<int> values;
  for (int row = -border; row < rows + border; ++row)
    for (int column = -border; column < columns + border; ++column) {
      const MapField::Place place = map.at(centerOf(column, row));
      const double value = beamValue(place.wall_distance_m, config.sigma_m, field.random_share);
      values.push_back(
          static_cast<int>(std::lround(255.0 * (place.known ? value : std::max(value, field.unknown_value)))));
    }
  std::vector<float> x_m, y_m;
  for (const Eigen::Vector2f& point : points) {
    x_m.push_back(point.x());
    y_m.push_back(point.y());
  }
  std::vector<std::int32_t> x_cells(points.size()), y_cells(points.size());
  const double top = 255.0 * static_cast<double>(points.size());
  std::vector<GridPose> poses;
  const int directions = static_cast<int>(std::ceil(std::numbers::pi * config.lever_m / config.sigma_m));
  for (int k = 0; k < directions; ++k) {
    const double yaw = 2.0 * std::numbers::pi * k / directions, scale = 1.0 / config.cell_m;
    const float middle = 0.5F + static_cast<float>(border);
    transformToCells(x_m, y_m, static_cast<float>(std::cos(yaw) * scale), static_cast<float>(std::sin(yaw) * scale),
                     middle, middle, x_cells, y_cells);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        if (!map.at(centerOf(column, row)).free) continue;
        int sum = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
          sum += values[static_cast<std::size_t>(row + y_cells[i]) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(column + x_cells[i])];
        if (sum > static_cast<int>(config.least_fit * top)) poses.push_back({-sum, k, row, column});
      }
  }
  std::sort(poses.begin(), poses.end());
  const auto same = [&](const GridPose& a, const GridPose& b) {
    const int off = std::abs(a.direction - b.direction), cells = static_cast<int>(config.distinct_m / config.cell_m);
    return std::abs(a.row - b.row) <= cells && std::abs(a.column - b.column) <= cells &&
           std::min(off, directions - off) <= static_cast<int>(config.distinct_deg / 360.0 * directions);
  };
  std::vector<GridPose> distinct;
  std::vector<FittingPlace> places;
  for (const GridPose& pose : poses) {
    if (-pose.score <= -poses.front().score - static_cast<int>(margin * top)) break;
    if (std::any_of(distinct.begin(), distinct.end(), [&](const GridPose& better) { return same(better, pose); }))
      continue;
    distinct.push_back(pose);
    const Eigen::Vector2d at = centerOf(pose.column, pose.row);
    places.push_back(
        {{at.x(), at.y(), common::wrapAngle(2.0 * std::numbers::pi * pose.direction / directions)}, -pose.score / top});
  }
  return places;
}

TEST(GlobalSearch, FindsThePlacesThatLookingAtEveryPoseFinds) {
  const test::Building building = test::hall(2);
  const auto field = fieldOf(building);
  const test::Walks walks(building);
  GlobalSearchConfig config;
  const GlobalSearch search(field, config);
  common::RandomStream random(5, "poses");
  std::size_t most = 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d at = walks.somewhere(random);
    std::vector<Eigen::Vector2f> points = pointsAt(building, {at.x(), at.y(), random.uniform(-3.1, 3.1)}, 10 + i);
    std::vector<Eigen::Vector2f> some;
    for (std::size_t k = 0; k < points.size(); k += 15) some.push_back(points[k]);
    const GlobalSearchResult found = search.search(some, 0.4);
    const std::vector<FittingPlace> expected = exhaustively(*field, config, 0.4, some);
    EXPECT_TRUE(found.complete);
    ASSERT_EQ(found.places.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(found.places[k].fit, expected[k].fit) << k;
      EXPECT_LT((found.places[k].T_grid_points.position_m() - expected[k].T_grid_points.position_m()).norm(), 1e-6);
      EXPECT_NEAR(found.places[k].T_grid_points.yaw_rad, expected[k].T_grid_points.yaw_rad, 1e-9) << k;
    }
    most = std::max(most, expected.size());
  }
  EXPECT_GT(most, 20U);
}

/// It may not have seen the best, then, but what it gives are places, and it says that there may be more.
TEST(GlobalSearch, WithRoomForFewBlocksItSaysThatThereMayBeMore) {
  const test::Building building = test::hall(2);
  GlobalSearchConfig config;
  config.max_blocks = 1000;
  const GlobalSearch search(fieldOf(building), config);
  std::vector<Eigen::Vector2f> few = pointsAt(building, {5.0, 0.0, 0.4});
  few.resize(12);
  const GlobalSearchResult found = search.search(few, 0.4);
  EXPECT_FALSE(found.complete);
  for (const FittingPlace& place : found.places) EXPECT_GT(place.fit, config.least_fit);
}

TEST(GlobalSearch, FindsBothOfTwinPlaces) {
  const test::Building building = test::twinWings(1);
  const GlobalSearch search(fieldOf(building), GlobalSearchConfig{});
  const Pose2 here{7.0, 0.2, 0.4}, twin = Pose2{0.0, 0.0, std::numbers::pi} * here;
  std::vector<Eigen::Vector2f> points = pointsAt(building, here);
  const GlobalSearchResult found = search.search(points, 0.1);
  const PlaceDistinction distinction{0.3, 0.15};
  for (const Pose2& pose : {here, twin})
    EXPECT_TRUE(std::any_of(found.places.begin(), found.places.end(), [&](const FittingPlace& place) {
      return distinction.same(place.T_grid_points, pose);
    })) << pose.x_m;
}

TEST(PlacePosterior, SharpensWhatTheSearchFound) {
  const test::Building building = test::offices(11);
  const auto field = fieldOf(building);
  const test::Walks walks(building);
  common::RandomStream random(6, "poses");
  const GlobalSearch search(field, GlobalSearchConfig{});
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector2d at = walks.somewhere(random);
    const Pose2 truth{at.x(), at.y(), random.uniform(-3.1, 3.1)};
    const std::vector<Eigen::Vector2f> points = pointsAt(building, truth, 20 + i);
    const auto found = search.search(points, 0.15);
    const auto places = likelyPlaces(bestInstructions(), *field, found.places, points, 0.15, 0.2, {0.5, 0.26});
    ASSERT_FALSE(places.empty());
    const bool contains = std::any_of(places.begin(), places.end(), [&](const LikelyPlace& place) {
      return (place.T_grid_points.position_m() - at).norm() < 0.12 &&
             std::abs(common::wrapAngle(place.T_grid_points.yaw_rad - truth.yaw_rad)) < 0.03 && place.explained > 0.9;
    });
    EXPECT_TRUE(contains) << truth.x_m << " " << truth.y_m << " " << truth.yaw_rad;
  }
}

TEST(ScanSupport, TellsExplainedFromContradictedAndFromUnknown) {
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
  // A room of 4 m by 4 m, wall at x = 4; nothing is known behind x = 6.
  for (int y = -40; y < 40; ++y) {
    for (int x = 0; x < 120; ++x) map.set({x, y}, -common::occupancy::kMaxSteps);
    map.set({80, y}, common::occupancy::kMaxSteps);
  }
  const MapField field(map, MapFieldConfig{});
  const Pose2 pose{1.0, 0.0, 0.0};
  const auto supportOfPoint = [&](float x, float y) {
    const std::vector<Eigen::Vector2f> points{{x, y}};
    return supportOf(field, points, pose, ScanSupportConfig{});
  };
  EXPECT_EQ(supportOfPoint(3.02F, 0.0F).explained, 1.0);
  EXPECT_EQ(supportOfPoint(2.0F, 0.0F).explained, 0.0);  // In front of the wall: something new.
  EXPECT_EQ(supportOfPoint(2.0F, 0.0F).evidence, 1);
  EXPECT_EQ(supportOfPoint(4.5F, 0.0F).explained, 0.0);  // Behind it.
  EXPECT_EQ(supportOfPoint(4.5F, 0.0F).evidence, 1);
  EXPECT_EQ(supportOfPoint(0.0F, 7.0F).evidence, 0);  // Nobody has been there.
  EXPECT_EQ(supportOfPoint(0.0F, 7.0F).beams, 1);
}

TEST(LostTest, NoticesAChangeHoweverLongAllWasWell) {
  LostTest test{LostTestConfig{}};
  const ScanSupport good{90, 90, 0.95}, bad{90, 90, 0.2}, none{90, 3, 0.0};
  for (int i = 0; i < 10'000; ++i) test.add(good, 0.1);
  EXPECT_FALSE(test.doubtful());
  for (int i = 0; i < 100; ++i) test.add(none, 0.1);
  EXPECT_FALSE(test.doubtful()) << "three beams say nothing";
  int scans = 0;
  while (!test.lost() && scans < 100) {
    test.add(bad, 0.1);
    ++scans;
  }
  EXPECT_LE(scans, 10) << "a second";
  test.reset();
  EXPECT_FALSE(test.lost());
}

TEST(LocalMap, OnTheSpotItKeepsTheLastScansOnly) {
  LocalMap map(2.0);
  for (int i = 0; i < 1000; ++i) map.add({0.0, 0.0, 0.26 * i}, {{1.0F, 0.0F}});
  EXPECT_EQ(map.whole(1e-6, 10'000).points_middle_m.size(), 200U);
}

TEST(Odometer, CountsNoTremblingAndEveryWay) {
  common::RandomStream tremble(5, "tremble");
  Odometer still, gone;
  for (int i = 0; i < 1000; ++i) {
    const common::Pose2 error{tremble.gaussian(0.005), tremble.gaussian(0.005), tremble.gaussian(0.005)};
    still.add(error);
    gone.add(common::Pose2{0.01 * i, 0.0, 0.01 * i} * error);
  }
  EXPECT_LT(still.path_length_m(), 0.05);
  EXPECT_LT(still.turned_rad(), 0.05);
  EXPECT_NEAR(gone.path_length_m(), 9.99, 0.3);
  EXPECT_NEAR(gone.turned_rad(), 9.99, 0.3);
  EXPECT_NEAR(gone.path_length_m(common::Pose2{11.0, 0.0, 0.0}) - gone.path_length_m(), 1.0, 0.1);
}

TEST(LocalMap, ForgetsWhatLiesFarBack) {
  LocalMap map(2.0);
  const std::vector<Eigen::Vector2f> points{{1.0F, 0.0F}, {1.0F, 1.0F}, {1.01F, 1.01F}};
  for (int i = 0; i <= 10; ++i) map.add({0.5 * i, 0.0, 0.0}, points);
  EXPECT_NEAR(map.length_m(), 2.0, 1e-9);
  const LocalMap::Whole whole = map.whole(0.15, 100);
  EXPECT_EQ(whole.points_middle_m.size(), 10U);  // The third point shares its square with the second.
  EXPECT_NEAR(whole.T_odom_middle.x_m, 4.0, 1e-9);
  EXPECT_LE(map.whole(0.15, 4).points_middle_m.size(), 4U);
}

}  // namespace
}  // namespace swiftlet::perception
