// The search of the whole map, against every pose of its grid.
#include <cmath>

#include <gtest/gtest.h>

#include "perception/localization/beam_sums.hpp"
#include "perception/localization/global_search.hpp"
#include "perception/localization/place_posterior.hpp"
#include "tests/localization/buildings.hpp"
#include "tests/localization/fields.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::fieldOf;
using test::pointsAt;

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
  std::vector<int> values;
  for (int row = -border; row < rows + border; ++row)
    for (int column = -border; column < columns + border; ++column) {
      const MapField::Place place = map.at(centerOf(column, row));
      const double value = beamValue(place.wall_distance_m, config.sigma_m, MapField::kRandomShare);
      values.push_back(
          static_cast<int>(std::lround(255.0 * (place.known ? value : std::max(value, MapField::kUnknownValue)))));
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

TEST(GlobalSearch, EqualsTheExhaustiveSearch) {
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

/// It may miss the best pose then, but its results are valid places, and it says that there may be more.
TEST(GlobalSearch, ReportsAnIncompleteSearchWhenMemoryIsShort) {
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

TEST(GlobalSearch, FindsBothOfTwoIdenticalPlaces) {
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

TEST(PlacePosterior, RefinesThePlacesOfTheSearch) {
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

}  // namespace
}  // namespace swiftlet::perception
