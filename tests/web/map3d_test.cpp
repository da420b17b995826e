// The 3D map on its way to the pages: streams from a viewpoint.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rendering/example_flight.hpp"
#include "tests/support/problem_matchers.hpp"
#include "web/server/frame_hub.hpp"
#include "web/server/route.hpp"

namespace swiftlet::web {
namespace {

using ::swiftlet::test_support::MessageIs;

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
    return refuse == nullptr ? common::Message() : refuse->reason;
  };
  EXPECT_THAT(reasonOf("view=above"), MessageIs("query.unknown-word", "whole, orbit, follow, camera"));
  EXPECT_THAT(reasonOf("view=orbit&distance=0.1"), MessageIs("query.too-low", "0.2 m"));
  EXPECT_THAT(reasonOf("view=orbit&distance=1001"), MessageIs("query.too-high", "1000 m"));
  EXPECT_THAT(reasonOf("elevation=90"), MessageIs("query.too-high", "89 degrees"));
  EXPECT_THAT(reasonOf("azimuth=-361"), MessageIs("query.too-low", "-360"));
  EXPECT_THAT(reasonOf("azimuth=nan"), MessageIs("query.too-low", "azimuth"));
  EXPECT_THAT(reasonOf("elevation=inf"), MessageIs("query.too-high", "elevation"));
  EXPECT_THAT(reasonOf("view=orbit&x=1e6"), MessageIs("query.too-high", "100000 m"));
  EXPECT_THAT(reasonOf("x=1"), MessageIs("query.without-effect", "view=orbit"));
  EXPECT_THAT(reasonOf("view=camera&azimuth=1"), MessageIs("query.without-effect", "azimuth"));
  EXPECT_THAT(reasonOf("distance=5"), MessageIs("query.without-effect", "distance"));
  EXPECT_THAT(reasonOf("color=red"), MessageIs("query.unknown-word", "measured, normal"));
  EXPECT_THAT(reasonOf("azimut=1"), MessageIs("query.unknown-parameter", "`azimuth`"));
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

TEST_F(HubStory, AClockThatIsSetBackStopsNoPictures) {
  testing::ExampleFlight flight;
  flight.carryCamera();
  for (const char* target : {"/stream/map.mjpg?width=80", "/stream/map3d.mjpg?width=160"}) {
    post(flight.advance(1.0));
    const auto before = frame(target);
    const common::Time sent = common::Time::fromSeconds(now_s);
    now_s -= 3600.0;
    EXPECT_EQ(hub.frame(*kept.back(), {.last = before, .period = {}, .sent = sent}), before) << "a picture is repeated";
    post(flight.advance(1.0));
    const auto next = frame(target, before);
    ASSERT_NE(next, nullptr);
    EXPECT_NE(next, before);
  }
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

}  // namespace
}  // namespace swiftlet::web
