// The 3D map on its way to the pages: streams from a viewpoint, and the points that a page draws itself.
#include <cmath>
#include <cstring>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rendering/example_flight.hpp"
#include "web/server/frame_hub.hpp"
#include "web/server/route.hpp"
#include "web/server/submap_feed.hpp"

namespace swiftlet::web {
namespace {

using ::testing::HasSubstr;

const Policy kMap3dPolicy{"secret-token", {}, {}};

Action routeOf(const std::string& target, bool websocket = false) {
  return route({"GET", target, "localhost", "", "", "", websocket}, kMap3dPolicy);
}

PictureView viewOf(const std::string& target) { return std::get<StreamPictures>(routeOf(target)).view; }

TEST(Map3dRouteTest, ReadsTheViewpoint) {
  using Kind = rendering::Viewpoint3d::Kind;
  const PictureView whole = viewOf("/stream/map3d.mjpg?width=320");
  EXPECT_EQ(whole.source, PictureView::Source::kMap3d);
  EXPECT_EQ(whole.viewpoint.kind, Kind::kWhole);
  EXPECT_EQ(whole.height_px, 240);
  const PictureView orbit =
      viewOf("/stream/map3d.mjpg?view=orbit&x=1.5&y=-2&z=0.5&distance=3&azimuth=90&elevation=-30&color=normal");
  EXPECT_EQ(orbit.viewpoint.kind, Kind::kOrbit);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.target_x_map_m, 1.5);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.target_y_map_m, -2.0);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.target_z_map_m, 0.5);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.distance_m, 3.0);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.azimuth_rad, M_PI / 2);
  EXPECT_DOUBLE_EQ(orbit.viewpoint.elevation_rad, -M_PI / 6);
  EXPECT_EQ(orbit.coloring, rendering::PointColor::kNormal);
  EXPECT_EQ(viewOf("/stream/map3d.mjpg?view=follow&distance=2").viewpoint.kind, Kind::kFollow);
  EXPECT_EQ(viewOf("/stream/map3d.mjpg?view=camera").viewpoint.kind, Kind::kCamera);
  EXPECT_EQ(viewOf("/stream/depth.mjpg?width=160").source, PictureView::Source::kDepth);
}

TEST(Map3dRouteTest, RefusesABadViewpointWithTheReason) {
  const auto reasonOf = [](const std::string& query) {
    const Action action = routeOf("/stream/map3d.mjpg?" + query);
    const auto* refuse = std::get_if<Refuse>(&action);
    EXPECT_TRUE(refuse != nullptr && refuse->status == 400) << query;
    return refuse == nullptr ? "" : refuse->reason;
  };
  EXPECT_THAT(reasonOf("view=above"), HasSubstr("view: `above` is none of whole, orbit, follow, camera"));
  EXPECT_THAT(reasonOf("view=orbit&distance=0.1"), HasSubstr("distance: `0.1` is not a number of at least 0.2 m"));
  EXPECT_THAT(reasonOf("view=orbit&distance=1001"), HasSubstr("distance: 1001 is not at most 1000 m"));
  EXPECT_THAT(reasonOf("elevation=90"), HasSubstr("elevation: 90 is not at most 89 degrees"));
  EXPECT_THAT(reasonOf("azimuth=-361"), HasSubstr("azimuth: `-361` is not a number of at least -360"));
  EXPECT_THAT(reasonOf("azimuth=nan"), HasSubstr("azimuth"));
  EXPECT_THAT(reasonOf("elevation=inf"), HasSubstr("elevation"));
  EXPECT_THAT(reasonOf("view=orbit&x=1e6"), HasSubstr("x: 1e+06 is not at most 100000 m"));
  EXPECT_THAT(reasonOf("x=1"), HasSubstr("x: only for view=orbit"));
  EXPECT_THAT(reasonOf("view=camera&azimuth=1"), HasSubstr("azimuth: only for other views than view=camera"));
  EXPECT_THAT(reasonOf("distance=5"), HasSubstr("distance: only for"));
  EXPECT_THAT(reasonOf("color=red"), HasSubstr("measured, normal"));
  EXPECT_THAT(reasonOf("azimut=1"), HasSubstr("did you mean `azimuth`"));
}

TEST(Map3dRouteTest, ThePointsNeedAWebSocket) {
  const Action plain = routeOf("/api/map3d");
  EXPECT_EQ(std::get<Refuse>(plain).status, 426);
  EXPECT_EQ(std::get<OpenSocket>(routeOf("/api/map3d", true)).feed, OpenSocket::Feed::kMap3d);
  EXPECT_EQ(std::get<OpenSocket>(routeOf("/api/ws", true)).feed, OpenSocket::Feed::kPage);
}

/// A hub with a clock that the test sets.
struct HubStory : ::testing::Test {
  void post(std::shared_ptr<const common::World> next) {
    now_s += 0.1;
    world.post(std::move(next));
    telemetry.look();
  }
  std::shared_ptr<const StreamFrame> frame(const std::string& target,
                                           const std::shared_ptr<const StreamFrame>& last = nullptr) {
    const auto view = hub.watch(viewOf(target));
    kept.push_back(view);
    const FrameHub::Watcher watcher{
        .last = last, .period = common::Duration::fromMilliseconds(100), .sent = common::Time::fromSeconds(now_s)};
    if (hub.due(*view, watcher)) hub.draw(*view, watcher);
    return hub.frame(*view, watcher);
  }

  double now_s = 1000.0;
  double step_s = 0.0;  ///< What each look at the clock takes.
  common::LatestValue<common::World> world;
  common::LatestValue<common::CameraFrame> camera;
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
  Telemetry telemetry{{world, camera, commands, results},
                      [this] { return common::Time::fromSeconds(now_s += step_s); }};
  FrameHub hub{telemetry, 0.55};
  std::vector<std::shared_ptr<FrameHub::View>> kept;
};

TEST_F(HubStory, OnePictureIsDrawnForAllWhoWatchFromTheSameViewpoint) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  post(flight.advance(2.0));
  const std::string there = "/stream/map3d.mjpg?width=160&view=orbit&azimuth=20";
  EXPECT_EQ(frame(there), frame(there));
  EXPECT_NE(frame(there)->bytes, frame("/stream/map3d.mjpg?width=160&view=orbit&azimuth=40")->bytes);
  EXPECT_NE(frame(there)->bytes, frame(there + "&color=normal")->bytes);
  const auto before = frame(there);
  post(flight.advance(1.0));
  EXPECT_NE(frame(there, before), before);
}

TEST_F(HubStory, TheOperatorsPictureDoesNotWaitForThoseOfViewers) {
  testing::ExampleFlight flight;
  post(flight.advance(2.0));
  const auto own = hub.watch(viewOf("/stream/map.mjpg?width=80"));
  const FrameHub::Watcher by_operator{.period = common::Duration::fromMilliseconds(100), .by_operator = true};
  hub.draw(*own, by_operator);
  step_s = 1.0;  // A slow machine.
  for (const char* width : {"81", "82", "83", "84"}) frame("/stream/map.mjpg?width=" + std::string(width));
  step_s = 0.0;
  post(flight.advance(1.0));
  EXPECT_TRUE(hub.due(*own, by_operator));
  EXPECT_FALSE(hub.due(*hub.watch(viewOf("/stream/map.mjpg?width=84")), {.period = by_operator.period}));
}

TEST_F(HubStory, AFlightWithoutACameraShowsOneNotice) {
  const auto waiting = frame("/stream/map3d.mjpg?width=160");
  const auto waiting_depth = frame("/stream/depth.mjpg?width=160");
  testing::ExampleFlight flight;
  post(flight.advance(1.0));
  const auto none = frame("/stream/map3d.mjpg?width=160", waiting);
  const auto none_depth = frame("/stream/depth.mjpg?width=160", waiting_depth);
  ASSERT_NE(none, nullptr);
  ASSERT_NE(none_depth, nullptr);
  EXPECT_NE(none->bytes, waiting->bytes);
  EXPECT_NE(none_depth->bytes, waiting_depth->bytes);
  post(flight.advance(0.2));
  EXPECT_EQ(frame("/stream/map3d.mjpg?width=160", none), nullptr);
  EXPECT_EQ(frame("/stream/depth.mjpg?width=160", none_depth), nullptr);
}

TEST_F(HubStory, ADepthImageIsSentOnceHoweverManyWorldsHoldIt) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  post(flight.advance(0.3));
  const auto first = frame("/stream/depth.mjpg?width=160");
  post(flight.advance(0.0));
  EXPECT_EQ(frame("/stream/depth.mjpg?width=160", first), nullptr);
  post(flight.advance(0.5));
  const auto second = frame("/stream/depth.mjpg?width=160", first);
  ASSERT_NE(second, nullptr);
  EXPECT_NE(second->bytes, first->bytes);
}

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

  Submap arriving;
  int adding = 0, replacing = 0;
  std::map<int, Submap> submaps;
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
  ASSERT_EQ(page.submaps.size(), map3d.submaps->size());
  ASSERT_EQ(page.poses.size(), map3d.submaps->size());
  for (std::size_t i = 0; i < page.poses.size(); ++i) {
    const common::Submap3d& submap = (*map3d.submaps)[i];
    EXPECT_LT((page.poses[i].cast<double>() - submap.T_map_submap(*map3d.keys).position_m).norm(), 1e-5);
    const Map3dPage::Submap& shown = page.submaps.at(static_cast<int>(i));
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
  EXPECT_EQ(page.submaps.at(1).points_m.size(), 1U);
}

}  // namespace
}  // namespace swiftlet::web
