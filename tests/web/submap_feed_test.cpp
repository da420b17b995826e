// The points of the 3D map that a page draws itself.
#include "web/server/submap_feed.hpp"

#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>

#include "mapping3d/model/point_grid.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::web {
namespace {

/// What a page has after the messages.
struct Map3dPage {
  struct Submap {
    std::vector<Eigen::Vector3f> points_m, normals;
    std::vector<std::array<std::uint8_t, 3>> colors;
  };

  template <typename Value>
  static Value at(const std::string& m, std::size_t offset) {
    Value value{};
    std::memcpy(&value, m.substr(offset, sizeof value).data(), sizeof value);
    return value;
  }

  void take(const SharedText& message) {
    const std::string& m = *message;
    bytes += m.size();
    ++counts[m[0]];
    if (m[0] == 4) {
      const auto count = at<std::uint16_t>(m, 2);
      ASSERT_EQ(m.size(), 8U + 28U * count);
      poses.clear();
      for (std::size_t i = 0; i < count; ++i)
        poses.emplace_back(at<float>(m, 8 + 28 * i), at<float>(m, 12 + 28 * i), at<float>(m, 16 + 28 * i));
    }
    if (m[0] == 3) takePoints(m);
  }

  void takePoints(const std::string& m) {
    const int number = at<std::uint16_t>(m, 2);
    const auto first = at<std::uint32_t>(m, 8), count = at<std::uint32_t>(m, 12);
    if (m[1] == 0 && first == 0) arriving = {};
    Submap& into = m[1] == 0 ? arriving : submaps[number];
    ASSERT_EQ(first, into.points_m.size()) << "the parts come in order";
    const auto step_m = at<float>(m, 16);
    for (std::size_t i = 20; i < m.size(); i += 12) {
      const Eigen::Vector3f steps(at<std::int16_t>(m, i), at<std::int16_t>(m, i + 2), at<std::int16_t>(m, i + 4));
      into.points_m.emplace_back(step_m * steps);
      into.normals.emplace_back(at<std::int8_t>(m, i + 6), at<std::int8_t>(m, i + 7), at<std::int8_t>(m, i + 8));
      into.colors.push_back({at<std::uint8_t>(m, i + 9), at<std::uint8_t>(m, i + 10), at<std::uint8_t>(m, i + 11)});
    }
    ++(m[1] == 0 ? replacing : adding);
    if (m[1] == 0 && into.points_m.size() == count) submaps[number] = std::move(arriving);
  }

  /// The two lists of a submap.
  Submap both(int list) const {
    const auto known = [&](int number) { return submaps.count(number) > 0 ? submaps.at(number) : Submap{}; };
    Submap all = known(list);
    const Submap noisy = known(list + 1);
    all.points_m.insert(all.points_m.end(), noisy.points_m.begin(), noisy.points_m.end());
    all.normals.insert(all.normals.end(), noisy.normals.begin(), noisy.normals.end());
    all.colors.insert(all.colors.end(), noisy.colors.begin(), noisy.colors.end());
    return all;
  }

  Submap arriving;
  int adding = 0, replacing = 0;
  std::map<int, Submap> submaps;  ///< By the number of the list.
  std::vector<Eigen::Vector3f> poses;
  std::map<char, int> counts;
  std::size_t bytes = 0;
};

/// Reads until there is nothing more.
void readAll(SubmapReader& reader, const SubmapFeed& feed, double now_s, Map3dPage& page) {
  for (auto messages = reader.next(feed, common::Time::fromSeconds(now_s), 1000); !messages.empty();
       messages = reader.next(feed, common::Time::fromSeconds(now_s), 1000))
    for (const SharedText& message : messages) page.take(message);
}

void expectSame(const Map3dPage& page, const common::Map3dLayer& map3d) {
  ASSERT_EQ(page.poses.size(), 2 * map3d.submaps->size());
  for (std::size_t i = 0; i < page.poses.size(); ++i) {
    const common::Submap3d& submap = (*map3d.submaps)[i / 2];
    EXPECT_LT((page.poses[i].cast<double>() - submap.T_map_submap(*map3d.keys).position_m).norm(), 1e-5);
    if (i % 2 == 1) continue;
    const Map3dPage::Submap shown = page.both(static_cast<int>(i));
    ASSERT_EQ(shown.points_m.size(), submap.points->size());
    for (std::size_t k = 0; k < shown.points_m.size(); ++k) {
      const common::SurfacePoint& point = (*submap.points)[k];
      ASSERT_LT((shown.points_m[k] - point.position_m).norm(), 5e-4F);
      ASSERT_LT((shown.normals[k] / 127.0F - point.normal).norm(), 0.01F);
      ASSERT_EQ(shown.colors[k], point.rgb);
    }
  }
}

TEST(SubmapFeedTest, APageHasTheMapWheneverItJoinsAndASettledSubmapIsSentOnce) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  SubmapFeed feed;
  SubmapReader early, late;
  Map3dPage early_page, late_page;
  std::shared_ptr<const common::World> world;
  for (int i = 0; i < 6; ++i) {
    world = flight.advance(2.0);
    feed.update(*world->map3d);
    readAll(early, feed, 100.0 * i, early_page);
  }
  for (int k = 0; k < 5; ++k) readAll(early, feed, 600.0 + 10.0 * k, early_page);  // What has moved since.
  readAll(late, feed, 600.0, late_page);
  expectSame(early_page, *world->map3d);
  expectSame(late_page, *world->map3d);
  const std::size_t had = early_page.bytes;
  feed.update(*world->map3d);
  readAll(early, feed, 700.0, early_page);
  EXPECT_EQ(early_page.bytes, had);
}

TEST(SubmapFeedTest, ALoopClosureSendsPosesOnly) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  feed.update(*flight.advance(12.0)->map3d);
  readAll(reader, feed, 0.0, page);
  page.counts.clear();
  page.bytes = 0;
  flight.closeLoop(0.3);
  const auto world = flight.advance(0.0);
  feed.update(*world->map3d);
  readAll(reader, feed, 100.0, page);
  EXPECT_EQ(page.counts[3], 0);
  EXPECT_EQ(page.counts[4], 1);
  EXPECT_LT(page.bytes, 1000U);
  expectSame(page, *world->map3d);
}

/// A map of submaps with these points, at the origin.
common::Map3dLayer layerOf(const std::vector<std::vector<common::SurfacePoint>>& submaps) {
  common::Map3dLayer map3d;
  std::vector<common::Submap3d> made;
  for (const auto& points : submaps) {
    made.emplace_back();
    made.back().points = std::make_shared<const std::vector<common::SurfacePoint>>(points);
  }
  map3d.submaps = std::make_shared<const std::vector<common::Submap3d>>(made);
  map3d.keys = std::make_shared<const common::KeyPoses>(common::KeyPoses{1, {{}}});
  return map3d;
}

std::vector<common::SurfacePoint> row(std::size_t count, float y_m, float apart_m = 0.03F) {
  std::vector<common::SurfacePoint> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i].position_m = {apart_m * static_cast<float>(i % 400), y_m, 0.0F};
  return points;
}

TEST(SubmapFeedTest, APointIsSentOnceWhileItsSubmapGrowsAndOnceMoreWhenItHasSettled) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  const auto next = [&](double now_s, const common::Map3dLayer& map3d) {
    feed.update(map3d);
    readAll(reader, feed, now_s, page);
    page.bytes = 0;
    readAll(reader, feed, now_s, page);
    EXPECT_EQ(page.bytes, 0U);
  };
  std::vector<common::SurfacePoint> growing;
  for (int i = 1; i <= 20; ++i) {
    growing = row(300 * static_cast<std::size_t>(i), 0.001F * static_cast<float>(i));  // Averaging moves all of them.
    next(0.2 * i, layerOf({growing}));
    EXPECT_EQ(page.submaps.at(0).points_m.size(), growing.size());
  }
  EXPECT_EQ(page.adding, 20);
  EXPECT_EQ(page.replacing, 0);
  next(10.0, layerOf({growing, row(10, 1.0F)}));
  EXPECT_EQ(page.replacing, 2) << "6000 points in two parts";
  expectSame(page, layerOf({growing, row(10, 1.0F)}));
}

TEST(SubmapFeedTest, ASubmapThatWasThinnedReplacesTheOldOne) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  const auto before = layerOf({row(5000, 0.0F), row(5, 1.0F)}), after = layerOf({row(2000, 0.0F, 0.07F), row(5, 1.0F)});
  feed.update(before);
  readAll(reader, feed, 0.0, page);
  feed.update(after);
  readAll(reader, feed, 0.0, page);
  expectSame(page, after);
}

TEST(SubmapFeedTest, SendingAgainTakesABoundedShareOfTheLink) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  for (int i = 0; i < 40; ++i) {
    // Ten submaps, all with other points each time.
    std::vector<std::vector<common::SurfacePoint>> submaps(10, row(2000, static_cast<float>(i)));
    feed.update(layerOf(submaps));
    readAll(reader, feed, 0.1 * i, page);
  }
  EXPECT_LT(static_cast<double>(page.bytes), 4.0 * SubmapReader::kRefreshBytesPerSecond + 12.0 * 22'000 + 10'000);
}

TEST(SubmapFeedTest, PointsAreSentAgainAlsoAfterTheClockWasSetBack) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  double now_s = 10'000.0;
  for (int i = 0; i < 6; ++i) {
    const auto moved = layerOf(std::vector(3, row(2000, static_cast<float>(i))));
    feed.update(moved);
    for (int k = 0; k < 5; ++k) readAll(reader, feed, now_s += 0.5, page);
    expectSame(page, moved);
    if (i == 2) now_s -= 3600.0;
  }
}

/// A map of one submap with the points of the grid.
common::Map3dLayer layerOfGrid(const mapping3d::PointGrid& grid) {
  common::Map3dLayer map3d = layerOf({std::vector<common::SurfacePoint>()});
  const mapping3d::WeightedPoints points = grid.points();
  common::Submap3d submap = map3d.submaps->front();
  submap.points = points.points;
  submap.coarse = points.points->size() - points.fine;
  map3d.submaps = std::make_shared<const std::vector<common::Submap3d>>(1, submap);
  return map3d;
}

TEST(SubmapFeedTest, NoisyPointsFollowTheOthersWhateverComesBeforeThem) {
  mapping3d::PointGrid grid(0.02);
  const auto add = [&](float from_m, float to_m, float weight) {
    std::vector<mapping3d::SeenPoint> points;
    for (float x = from_m; x < to_m; x += 0.01F)
      for (float y = 0.0F; y < 0.5F; y += 0.05F)
        points.push_back({{x, y, 0.0F}, Eigen::Vector3f::Zero(), {1, 2, 3}, weight});
    grid.add(points, {});
  };
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  double now_s = 0.0;
  const auto send = [&] {
    feed.update(layerOfGrid(grid));
    readAll(reader, feed, now_s += 10.0, page);
    expectSame(page, layerOfGrid(grid));
  };
  constexpr float kWell = 1e4F, kNoisy = 600.0F;
  add(0.0F, 1.0F, kWell);
  send();
  add(1.0F, 4.0F, kNoisy);
  send();
  const int replaced = page.replacing;
  add(1.0F, 1.5F, kWell);  // Some noisy points are seen better.
  send();
  EXPECT_EQ(page.replacing, replaced + 1) << "only the noisy points are sent again";
  add(1.5F, 4.0F, kWell);
  send();
  EXPECT_EQ(page.submaps.at(1).points_m.size(), 0U);
}

TEST(SubmapFeedTest, NoisyPointsThatChangeDoNotFillTheLink) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  for (int i = 0; i < 100; ++i) {
    mapping3d::PointGrid grid(0.02);
    grid.add(std::vector<mapping3d::SeenPoint>(1, {{0.0F, 0.001F * static_cast<float>(i), 0.0F}, {}, {}, 600.0F}), {});
    feed.update(layerOfGrid(grid));
    readAll(reader, feed, 0.1 * i, page);
  }
  EXPECT_LE(page.replacing, 6) << "each two seconds in ten";
}

TEST(SubmapFeedTest, ALargeSubmapHasALargerStep) {
  SubmapFeed feed;
  SubmapReader reader;
  Map3dPage page;
  const auto map3d =
      layerOf({{{{40.0F, -50.0F, 3.0F}, {0, 0, 1}, {1, 2, 3}}, {{0.0F, 0.0F, 0.0F}, {0, 0, 1}, {1, 2, 3}}}});
  feed.update(map3d);
  readAll(reader, feed, 0.0, page);
  EXPECT_LT((page.submaps.at(0).points_m.at(0) - Eigen::Vector3f(40, -50, 3)).norm(), 2e-3F);
}

TEST(SubmapFeedTest, AnEmptySubmapAndPointsThatAreNotFiniteDoNoHarm) {
  const float nan = std::nanf("");
  SubmapFeed feed;
  feed.update(layerOf({{}, {{{nan, 1.0F, INFINITY}, {nan, 0.0F, 0.0F}, {1, 2, 3}}}}));
  SubmapReader reader;
  Map3dPage page;
  readAll(reader, feed, 0.0, page);
  EXPECT_EQ(page.submaps.count(0), 0U);
  EXPECT_EQ(page.submaps.at(2).points_m.size(), 1U);
}

}  // namespace
}  // namespace swiftlet::web
