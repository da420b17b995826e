// The parts of localization, each against a slow and simple computation.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "perception/localization/beam_sums.hpp"
#include "perception/localization/kld_sampling.hpp"
#include "perception/localization/local_map.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/localization/odometer.hpp"
#include "perception/localization/particle_filter.hpp"
#include "perception/localization/scan_support.hpp"
#include "tests/localization/buildings.hpp"
#include "tests/localization/fields.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::fieldOf;

TEST(MapField, DistancesEqualTheDistanceToTheNearestWall) {
  const test::Building building = test::offices(3);
  const common::OccupancyGrid map = test::mapOf(building);
  const MapField field(map);
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

TEST(MapField, IndexesTheFreeCellsRowByRow) {
  const common::OccupancyGrid map = test::mapOf(test::offices(3));
  const MapField field(map);
  const common::CellRect known = common::knownExtent(map);
  std::size_t n = 0;
  for (int y = known.begin.y; y < known.end.y; ++y)
    for (int x = known.begin.x; x < known.end.x; ++x)
      if (common::occupancy::isFree(map.at({x, y}))) {
        ASSERT_EQ(field.freeCell_m(n++), map.centerOf({x, y}));
      }
  EXPECT_EQ(field.freeCells(), n);
}

TEST(MapField, RaysEndAtTheWallsOfTheWorld) {
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

TEST(BeamSums, EveryInstructionSetEqualsTheScalarCode) {
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

TEST(CosinesAndSines, EqualTheStandardLibrary) {
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

TEST(KldSampling, SampleSizeIsThatOfFox2003) {
  // Equation 7 of Fox 2003 at 100 bins, error 0.05, 99 %: chi-square quantile 134.6 over 2 epsilon.
  EXPECT_NEAR(kldSampleSize(100, 0.05, 2.326), 134.64 / 0.1, 3.0);
  EXPECT_EQ(kldSampleSize(1, 0.05, 2.326), 1.0);
}

TEST(KldSampling, NanAndHugeValuesFallIntoBins) {
  PoseBins bins(0.25, 0.17);
  for (const double value : {0.0, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) bins.add(value, 0.0, 0.0);
  bins.add(0.3, 0.0, 0.0);
  bins.add(-0.1, 0.0, 0.0);
  EXPECT_EQ(bins.occupied(), 5U);
}

TEST(ScanSupport, DistinguishesExplainedContradictedAndUnknownBeams) {
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
  // A room of 4 m by 4 m, wall at x = 4; nothing is known behind x = 6.
  for (int y = -40; y < 40; ++y) {
    for (int x = 0; x < 120; ++x) map.set({x, y}, -common::occupancy::kMaxSteps);
    map.set({80, y}, common::occupancy::kMaxSteps);
  }
  const MapField field(map);
  const Pose2 pose{1.0, 0.0, 0.0};
  const auto supportOfPoint = [&](float x, float y) {
    const std::vector<Eigen::Vector2f> points{{x, y}};
    return supportOf(field, points, pose);
  };
  EXPECT_EQ(supportOfPoint(3.02F, 0.0F).explained, 1.0);
  EXPECT_EQ(supportOfPoint(2.0F, 0.0F).explained, 0.0);  // In front of the wall: a new object.
  EXPECT_EQ(supportOfPoint(2.0F, 0.0F).evidence, 1);
  EXPECT_EQ(supportOfPoint(4.5F, 0.0F).explained, 0.0);  // Behind it.
  EXPECT_EQ(supportOfPoint(4.5F, 0.0F).evidence, 1);
  EXPECT_EQ(supportOfPoint(0.0F, 7.0F).evidence, 0);  // An unknown place.
  EXPECT_EQ(supportOfPoint(0.0F, 7.0F).beams, 1);
}

TEST(ScanSupport, ABoxBesideTheRobotThatIsGoneIsOneChange) {
  // A room of 6 m by 6 m, and in the map a box of 20 cm, 15 cm before the robot: half of all beams pass where it was.
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool wall = x == 0 || y == 0 || x == 119 || y == 119;
      const bool box = x >= 63 && x < 67 && y >= 58 && y < 62;
      map.set({x, y}, wall || box ? common::occupancy::kMaxSteps : -common::occupancy::kMaxSteps);
    }
  const MapField field(map);
  const Pose2 pose{3.0, 3.0, 0.0};
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 90; ++i) {
    const double angle_rad = common::kRadPerDeg * (i - 45);
    points.emplace_back(Eigen::Vector2d(2.97, 2.97 * std::tan(angle_rad)).cast<float>());
  }
  const ScanSupport support = supportOf(field, points, pose);
  EXPECT_GT(support.explained, 0.75);
  EXPECT_LE(LostTest{}.logOdds(support), 0.0);
}

TEST(LostTest, DetectsAChangeSoonAfterALongGoodTime) {
  LostTest test;
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

TEST(LocalMap, KeepsOnlyTheLastScansAtRest) {
  LocalMap map(2.0);
  for (int i = 0; i < 1000; ++i) map.add({0.0, 0.0, 0.26 * i}, {{1.0F, 0.0F}});
  EXPECT_EQ(map.whole(1e-6, 10'000).points_middle_m.size(), 200U);
}

TEST(Odometer, IgnoresJitterAndCountsEveryMotion) {
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

TEST(LocalMap, ForgetsScansFarBack) {
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
