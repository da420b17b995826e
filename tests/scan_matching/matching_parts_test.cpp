// The parts of the matcher, each against a slow and simple computation.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "perception/scan_matching/branch_and_bound.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/scan_matching/quadratic_peak.hpp"
#include "perception/scan_matching/reference_view.hpp"
#include "perception/scan_matching/scan_contour.hpp"
#include "perception/scan_matching/score_surface.hpp"
#include "perception/scan_matching/split_points.hpp"
#include "perception/scan_matching/window_sums.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

RC_GTEST_PROP(WindowSums, EveryInstructionSetGivesTheSameSums, ()) {
  constexpr int kStride = 64, kRows = 40;
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const int count = *rc::gen::inRange(0, kMaxWindowPoints + 1), rows = *rc::gen::inRange(1, 18);
  common::RandomStream random(seed, "sums");
  std::vector<std::uint8_t> cells(kStride * kRows + 16);
  for (auto& cell : cells) cell = random.chance(0.3) ? 255 : static_cast<std::uint8_t>(random.bits());
  std::vector<std::int32_t> offsets;
  for (int i = 0; i < count; ++i)
    offsets.push_back(static_cast<std::int32_t>(random.uniform() * (kRows - rows)) * kStride +
                      static_cast<std::int32_t>(random.uniform() * kStride));
  std::vector<int> expected(static_cast<std::size_t>(rows) * kWindowColumns, 0);
  for (const auto offset : offsets)
    for (std::size_t i = 0; i < expected.size(); ++i)
      expected[i] +=
          cells.at(static_cast<std::size_t>(offset) + std::size_t{kStride} * (i / kWindowColumns) + i % kWindowColumns);
  for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
    if (!isAvailable(instructions)) continue;
    std::vector<std::uint16_t> sums(expected.size());
    sumWindows(instructions, cells.data(), kStride, offsets, rows, sums.data());
    for (std::size_t i = 0; i < sums.size(); ++i) RC_ASSERT(static_cast<int>(sums[i]) == expected[i]);
  }
}

RC_GTEST_PROP(WindowSums, CellsAreRoundedDown, ()) {
  common::RandomStream random(*rc::gen::arbitrary<std::uint64_t>(), "cells");
  const int size = *rc::gen::inRange(0, 23);
  std::vector<float> x, y;
  for (int i = 0; i < size; ++i) {
    x.push_back(static_cast<float>(random.uniform(-20.0, 20.0)));
    y.push_back(static_cast<float>(random.uniform(-20.0, 20.0)));
  }
  const auto c = static_cast<float>(100.0 * std::cos(1.0)), s = static_cast<float>(100.0 * std::sin(1.0));
  std::vector<std::int32_t> cx(x.size()), cy(x.size());
  transformToCells(x, y, c, s, 3.25F, -7.5F, cx, cy);
  for (std::size_t i = 0; i < x.size(); ++i) {
    RC_ASSERT(cx[i] == static_cast<std::int32_t>(std::floor(c * x[i] - s * y[i] + 3.25F)));
    RC_ASSERT(cy[i] == static_cast<std::int32_t>(std::floor(s * x[i] + c * y[i] + -7.5F)));
  }
}

std::vector<ContourSegment> randomContour(common::RandomStream& random, int size) {
  std::vector<ContourSegment> contour;
  for (int i = 0; i < size; ++i) {
    const Eigen::Vector2d begin(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    contour.push_back({begin, begin + Eigen::Vector2d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5))});
  }
  return contour;
}

double distanceTo(const ContourSegment& segment, const Eigen::Vector2d& p) {
  const Eigen::Vector2d edge = segment.end_m - segment.begin_m;
  const double share = std::clamp((p - segment.begin_m).dot(edge) / std::max(edge.squaredNorm(), 1e-12), 0.0, 1.0);
  return (segment.begin_m + share * edge - p).norm();
}

TEST(LikelihoodField, DependsOnTheDistanceToTheNearestContour) {
  common::RandomStream random(2, "field");
  const auto contour = randomContour(random, 12);
  LikelihoodField field(0.01, 0.02);
  field.draw(contour);
  for (int trial = 0; trial < 20000; ++trial) {
    const int x = static_cast<int>(random.uniform() * field.width()),
              y = static_cast<int>(random.uniform() * field.height());
    const Eigen::Vector2d center((field.beginX() + x + 0.5) * 0.01, (field.beginY() + y + 0.5) * 0.01);
    double distance_m = 1e9;
    for (const ContourSegment& segment : contour) distance_m = std::min(distance_m, distanceTo(segment, center));
    // Contours are drawn as dots one cell apart, at positions rounded to a quarter of a cell.
    const double found_m =
        field.at(x, y) == 0 ? field.reach_m() : field.reach_m() * std::sqrt(1.0 - field.at(x, y) / 255.0);
    EXPECT_NEAR(found_m, std::min(distance_m, field.reach_m()), 0.006);
  }
}

TEST(LikelihoodField, CoarseCellsAreUpperBoundsForTheirBlock) {
  common::RandomStream random(3, "bound");
  LikelihoodField field(0.01, 0.02);
  field.draw(randomContour(random, 6));
  field.prepare(3, 100);
  field.draw(randomContour(random, 6));  // Drawing more must update the levels too.
  field.prepare(LikelihoodField::kLevels - 1, 200);
  for (int k = 1; k < LikelihoodField::kLevels; ++k) {
    const LikelihoodField::Level level = field.level(k);
    for (int trial = 0; trial < 20000; ++trial) {
      const int x = static_cast<int>(random.uniform() * (field.width() - 200));
      const int y = static_cast<int>(random.uniform() * (field.height() - 200));
      const int dx = static_cast<int>(random.uniform() * (1 << k)), dy = static_cast<int>(random.uniform() * (1 << k));
      ASSERT_GE(level.cells[(y >> k) * level.stride + (x >> k)], field.at(x + dx, y + dy)) << k;
    }
  }
}

TEST(LikelihoodField, GrowsWithoutLossAndClears) {
  common::RandomStream random(4, "grow");
  auto near = randomContour(random, 6), far = near;
  for (ContourSegment& s : far) s = {s.begin_m + Eigen::Vector2d(-15.0, 9.0), s.end_m + Eigen::Vector2d(-15.0, 9.0)};
  std::vector<ContourSegment> both = near;
  both.insert(both.end(), far.begin(), far.end());
  LikelihoodField step_by_step(0.01, 0.02), at_once(0.01, 0.02);
  step_by_step.draw(near);
  step_by_step.prepare(4, 64);
  step_by_step.draw(far);
  at_once.draw(both);
  const auto valueAt = [](const LikelihoodField& f, int x, int y) { return f.at(x - f.beginX(), y - f.beginY()); };
  for (int y = -400; y < 1400; ++y)
    for (int x = -1900; x < 400; ++x) ASSERT_EQ(valueAt(step_by_step, x, y), valueAt(at_once, x, y));

  step_by_step.prepare(LikelihoodField::kLevels - 1, 64);
  step_by_step.clear();
  EXPECT_TRUE(step_by_step.empty());
  for (int k = 0; k < LikelihoodField::kLevels; ++k) {
    const LikelihoodField::Level level = step_by_step.level(k);
    for (int i = 0; i < (step_by_step.height() >> k) * level.stride; ++i) ASSERT_EQ(level.cells[i], 0) << k;
  }
}

TEST(ScanContour, JoinsSurfacesButNotJumpsInRange) {
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(2.0F, -1.0F + 0.05F * static_cast<float>(i));  // A wall.
  for (int i = 0; i < 20; ++i)
    points.emplace_back(2.25F, 0.0F + 0.05F * static_cast<float>(i));  // A second wall behind the first.
  int leaps = 0;
  for (const ContourSegment& s : contourOf(points, 0.3, 20.0)) leaps += s.begin_m.x() != s.end_m.x() ? 1 : 0;
  EXPECT_EQ(leaps, 0);
  EXPECT_EQ(contourOf(points, 0.3, 20.0).size(), 38U);
  // A grazing wall stretches step by step and stays one contour.
  points.clear();
  for (float x = 1.0F, gap = 0.05F; x < 3.0F; x += gap, gap *= 1.15F) points.emplace_back(x, 1.0F);
  EXPECT_EQ(contourOf(points, 0.5, 20.0).size(), points.size() - 1);
  EXPECT_TRUE(contourOf({}, 0.3, 20.0).empty());
}

TEST(ScanContour, SpreadsPointsEvenly) {
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.001F * static_cast<float>(i), 1.0F);      // Dense points.
  for (int i = 1; i < 50; ++i) points.emplace_back(1.0F + 0.02F * static_cast<float>(i), 1.0F);  // Sparse points.
  const auto chosen = spreadPoints(points, 40, 20.0);
  EXPECT_LE(chosen.size(), 40U);
  EXPECT_GE(chosen.size(), 38U);
  const auto dense = std::count_if(chosen.begin(), chosen.end(), [](const auto& p) { return p.x() < 1.0F; });
  EXPECT_NEAR(static_cast<double>(dense), 20.0, 2.0);
}

TEST(ScanContour, ThinningDoesNotBiasThePoints) {
  // A wall to the right and one to the left, seen in beam order: along one the ranges grow, along the other they
  // shrink.
  constexpr double kNoise_m = 0.01;
  Eigen::Vector2d mean_m = Eigen::Vector2d::Zero(), count = Eigen::Vector2d::Zero();
  for (std::uint64_t scan = 0; scan < 100; ++scan) {
    common::RandomStream random(5, "walls", scan);
    std::vector<Eigen::Vector2f> points;
    std::vector<double> errors_m;
    for (int beam = 0; beam < 1081; ++beam) {
      const double angle_rad = (0.25 * beam - 135.0) * common::kRadPerDeg;
      const double range_m = std::min(1.0 / std::abs(std::sin(angle_rad)), 8.0 / std::abs(std::cos(angle_rad)));
      errors_m.push_back(random.gaussian(kNoise_m));
      const double measured_m = range_m + errors_m.back();
      points.emplace_back(static_cast<float>(measured_m * std::cos(angle_rad)),
                          static_cast<float>(measured_m * std::sin(angle_rad)));
    }
    for (const int i : spreadIndices(points, 400, 20.0)) {
      const int side = i < 540 ? 0 : 1;
      mean_m(side) += errors_m[static_cast<std::size_t>(i)];
      count(side) += 1.0;
    }
  }
  mean_m = mean_m.cwiseQuotient(count);
  printf("  mean error of the chosen: %.2f mm right, %.2f mm left\n", 1e3 * mean_m(0), 1e3 * mean_m(1));
  EXPECT_LT(mean_m.cwiseAbs().maxCoeff(), 4.0 * kNoise_m / std::sqrt(count.minCoeff()));
}

TEST(ScanContour, NormalsDistinguishACorridorFromARoom) {
  std::vector<float> x, y;
  common::RandomStream random(1, "normals");
  for (int side : {-1, 1})
    for (int i = 0; i < 200; ++i) {
      x.push_back(0.05F * static_cast<float>(i));
      y.push_back(static_cast<float>(side + random.gaussian(0.01)));
    }
  EXPECT_LT(motionSpread(x, y, leverOf_m(x, y))(0, 0), 0.02);
  const auto sliding = slidingMotion(motionSpread(x, y, leverOf_m(x, y)), leverOf_m(x, y), 0.02);
  ASSERT_TRUE(sliding);
  EXPECT_EQ(sliding->change.z(), 0.0) << "straight walls turn about nothing";
  for (int i = 0; i < 40; ++i) {
    x.push_back(static_cast<float>(10.0 + random.gaussian(0.01)));
    y.push_back(1.0F - 0.05F * static_cast<float>(i));
  }
  EXPECT_GT(motionSpread(x, y, leverOf_m(x, y))(0, 0), 0.06);
}

TEST(ScoreSurface, FitsAQuadraticExactly) {
  Eigen::Matrix3d hessian;
  hessian << -40.0, 6.0, -4.0, 6.0, -30.0, 8.0, -4.0, 8.0, -20.0;
  const Eigen::Vector3d gradient(24.0, -18.0, 12.0);
  ScoreSurface surface;
  for (int k = -3; k <= 3; ++k)
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i) {
        const Eigen::Vector3d u(i, j, k);
        surface.at(i, j, k) =
            static_cast<std::uint32_t>(std::lround(5000.0 + gradient.dot(u) + 0.5 * u.dot(hessian * u)));
      }
  const Quadratic q = fitQuadratic(surface);
  EXPECT_LT((q.hessian - hessian).norm(), 0.1);
  EXPECT_LT((q.gradient - gradient).norm(), 0.1);
  EXPECT_NEAR(q.constant, 5000.0, 0.5);
}

/// A cluster far ahead: the position may swing about it with the heading. The heading is hardly known, the position is.
TEST(QuadraticPeak, KeepsTheMoreCertainPartOfThePriorInAnUnobservableDirection) {
  Quadratic quadratic;
  const Eigen::Vector3d unseen = Eigen::Vector3d(0.0, 1.0, -1.0).normalized();
  quadratic.hessian = -100.0 * (Eigen::Matrix3d::Identity() - unseen * unseen.transpose());
  PeakScale scale;
  scale.step = {0.01, 0.01, 0.002};
  scale.information_per_curvature = 1e4;
  scale.unobservable_sigma_m = 0.1;
  scale.reach_steps = 5.0;
  const ExpectedPose by_position{{0.0, 0.02, 0.3}, {0.05, 0.05, 0.5}};
  EXPECT_NEAR(findPeak(quadratic, scale, by_position).offset.y(), 0.02, 0.01);
  const ExpectedPose by_heading{{0.0, 0.02, 0.3}, {5.0, 5.0, 0.01}};
  const Peak turned = findPeak(quadratic, scale, by_heading);
  EXPECT_NEAR(turned.offset.z(), 0.3, 0.01);
  EXPECT_NEAR(turned.offset.y(), -1.5, 0.05);
}

/// The best pose that is not adjacent to the best: from a full search, with half a turn to the left equal to one to the
/// right.
TEST(BranchAndBound, SearchAroundAnExclusionEqualsTheExhaustiveOne) {
  const ProjectedScan scan = test::scanAt(test::flat(), {0.5, 0.3, 0.4}, 1);
  LikelihoodField field(0.05, 0.1);
  field.draw(contourOf(scan.points_level_m, 0.3, 20.0));
  const std::vector<Eigen::Vector2f> points = spreadPoints(scan.points_level_m, 120, 20.0);
  const double step_rad = 4.0 * common::kRadPerDeg;
  BranchAndBound search(bestInstructions());
  for (const double turned_rad : {0.0, 1.0, std::numbers::pi}) {
    // The best pose is in the middle of the window, between, and at both of its ends.
    const PoseGrid grid{-0.3, -0.3, turned_rad - 45 * step_rad, step_rad, 91, 13};
    const BestPose best = search.search(field, points, grid, {}, 0);
    const ExcludedPoses here{best, 3, 4};
    const SplitPoints split(points);
    std::vector<std::int32_t> x_cells, y_cells;
    int expected = 0;
    for (int k = 0; k < grid.rotations; ++k) {
      BranchAndBound::allCellsAt(field, split.x_m, split.y_m, grid.first_yaw_rad + k * step_rad, grid.first_x_m,
                                 grid.first_y_m, x_cells, y_cells);
      const int apart = std::abs(k - best.rotation);
      const bool same_rotation = std::min(apart, 90 - apart) <= here.half_rotation || apart > 90 - here.half_rotation;
      for (int y = 0; y < grid.translations; ++y)
        for (int x = 0; x < grid.translations; ++x) {
          if (same_rotation && std::abs(x - best.x) <= here.half_translation &&
              std::abs(y - best.y) <= here.half_translation)
            continue;
          int score = 0;
          for (std::size_t i = 0; i < points.size(); ++i) score += field.at(x_cells[i] + x, y_cells[i] + y);
          expected = std::max(expected, score);
        }
    }
    EXPECT_EQ(search.searchElsewhere(field, points, grid, here, 0).score, expected) << turned_rad;
    EXPECT_LT(expected, best.score) << turned_rad;
  }
}

TEST(ReferenceView, EndsBehindWallsAndAtTheEdgeOfTheFieldOfView) {
  // A wall ahead at x = 4, seen over half a turn by a laser that stands at (1, 0) and looks along x.
  std::vector<Eigen::Vector2f> points;
  for (int deg = -89; deg <= 89; ++deg) {
    const double angle_rad = deg * std::numbers::pi / 180.0;
    const double range_m = std::min(3.0 / std::cos(angle_rad), 8.0);
    points.emplace_back(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
  }
  ReferenceView view;
  view.add(points, {1.0, 0.0, 0.0});
  const auto sees = [&](float x, float y, const Pose2& body, double margin_m) -> bool {
    return view.look(std::vector<float>{x}, std::vector<float>{y}, body, margin_m).front() ==
           ReferenceView::Sight::kSeen;
  };
  EXPECT_TRUE(sees(4.0F, 0.0F, {}, 0.0)) << "on the wall";
  EXPECT_TRUE(sees(2.0F, 1.0F, {}, 0.0)) << "before it";
  EXPECT_FALSE(sees(5.0F, 0.0F, {}, 0.0)) << "behind it";
  EXPECT_FALSE(sees(0.5F, 1.0F, {}, 0.0)) << "behind the laser";
  EXPECT_TRUE(sees(1.1F, 1.0F, {}, 0.0));
  EXPECT_FALSE(sees(1.1F, 1.0F, {}, 0.3)) << "too near to where the view ends";
  EXPECT_TRUE(sees(2.0F, 1.0F, {}, 0.3));
  EXPECT_TRUE(sees(0.0F, 3.0F, {1.0, 0.0, -std::numbers::pi / 2}, 0.0)) << "turned to it";
  view.clear();
  EXPECT_FALSE(sees(4.0F, 0.0F, {}, 0.0));
}

TEST(ReferenceView, OverAFullTurnHasNoEdge) {
  std::vector<Eigen::Vector2f> points;
  for (int deg = 0; deg < 360; deg += 2) {
    const double angle_rad = deg * std::numbers::pi / 180.0;
    points.emplace_back(3.0 * std::cos(angle_rad), 3.0 * std::sin(angle_rad));
  }
  ReferenceView view;
  view.add(points, {});
  for (int deg = 0; deg < 360; deg += 7) {
    const double angle_rad = deg * std::numbers::pi / 180.0;
    const std::vector<float> x{static_cast<float>(2.9 * std::cos(angle_rad))};
    const std::vector<float> y{static_cast<float>(2.9 * std::sin(angle_rad))};
    EXPECT_EQ(view.look(x, y, {}, 1.0).front(), ReferenceView::Sight::kSeen) << deg;
  }
}

/// The contour of a wall along x = 4 m, from y = -2 m to 2 m, as a laser at `body` sees it, in its frame.
std::vector<Eigen::Vector2f> wallSeenFrom(const Pose2& body) {
  std::vector<Eigen::Vector2f> points;
  const bool inside = body.x_m < 4.0;
  for (int i = -20; i <= 20; ++i)  // By increasing angle, as the beams of a laser go round.
    points.push_back((body.inverse() * Eigen::Vector2d(inside ? 4.0 : 4.12, (inside ? 0.1 : -0.1) * i)).cast<float>());
  return points;
}

TEST(ReferenceView, DoesNotSeeTheBackOfAWall) {
  const Pose2 room{2.0, 0.0, 0.0}, beside{3.0, 1.5, 0.0}, outside{5.0, 0.0, std::numbers::pi};
  ReferenceView view;
  view.add(wallSeenFrom(room), room);
  const auto look = [&](const Pose2& body) {
    const std::vector<Eigen::Vector2f> points = wallSeenFrom(body);
    std::vector<float> x, y;
    for (const Eigen::Vector2f& p : points) x.push_back(p.x()), y.push_back(p.y());
    return view.look(x, y, body, 0.0);
  };
  const auto count = [](const std::vector<ReferenceView::Sight>& sights, ReferenceView::Sight sight) {
    return std::count(sights.begin(), sights.end(), sight);
  };
  EXPECT_EQ(count(look(beside), ReferenceView::Sight::kBackOfSeen), 0);
  EXPECT_GT(count(look(beside), ReferenceView::Sight::kSeen), 35);
  // The outer face is 12 cm behind the inner one, as near as a rough wall may be.
  EXPECT_EQ(count(look(outside), ReferenceView::Sight::kBackOfSeen), 41);
  view.add(wallSeenFrom(outside), outside);
  EXPECT_EQ(count(look(outside), ReferenceView::Sight::kBackOfSeen), 0);
  EXPECT_GT(count(look(outside), ReferenceView::Sight::kSeen), 35);
}

/// Range noise of 2 cm turns the normals of a stretch that is seen at a grazing angle by tens of degrees.
TEST(ReferenceView, ANoisyWallSeenAlongIsNotTakenForItsBack) {
  common::RandomStream random(4, "noise");
  const auto alongside = [&](double x_m) {
    std::vector<Eigen::Vector2f> points;
    for (int deg = 2; deg <= 88; ++deg) {
      const double angle_rad = deg * std::numbers::pi / 180.0;
      const double range_m = std::min((1.0 - 0.0) / std::sin(angle_rad) + random.gaussian(0.02), 12.0);
      points.emplace_back(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    }
    return std::pair{points, Pose2{x_m, 0.0, 0.0}};
  };
  int backs = 0, points = 0;
  for (int trial = 0; trial < 20; ++trial) {
    ReferenceView view;
    const auto [reference, at] = alongside(0.0);
    view.add(reference, at);
    const auto [scan, body] = alongside(0.5);
    const SplitPoints split(scan);
    for (const ReferenceView::Sight sight : view.look(split.x_m, split.y_m, body, 0.0))
      backs += sight == ReferenceView::Sight::kBackOfSeen;
    points += static_cast<int>(scan.size());
  }
  EXPECT_LT(backs, points / 200);
}

TEST(ReferenceView, AWallSeenFromTheOtherSideMatchesNothing) {
  const Pose2 room{2.0, 0.0, 0.0}, outside{5.0, 0.0, std::numbers::pi};
  CorrelativeMatcher matcher{CorrelativeMatcherConfig{}};
  ProjectedScan inner, outer;
  inner.points_level_m = wallSeenFrom(room);
  outer.points_level_m = wallSeenFrom(outside);
  matcher.addReference(inner, room);
  EXPECT_FALSE(matcher.match(inner, room, {0.2, 0.1}).failed);
  EXPECT_TRUE(matcher.match(outer, outside, {0.2, 0.1}).failed);
}

}  // namespace
}  // namespace swiftlet::perception
