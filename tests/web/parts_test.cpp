// The parts behind the sockets: tiles, commands, JSON.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <nlohmann/json.hpp>

#include "common/submap3d.hpp"
#include "common/voxel_map.hpp"
#include "tests/rendering/example_flight.hpp"
#include "web/server/command_desk.hpp"
#include "web/server/state_json.hpp"
#include "web/server/telemetry.hpp"
#include "web/server/tile_codec.hpp"
#include "web/server/tile_feed.hpp"

namespace swiftlet::web {
namespace {

using common::occupancy::Cell;
constexpr int kTile = common::OccupancyGrid::kTileSize;

/// The shades of a tile, row by row, as the page reads them.
std::vector<int> decodeTile(const std::string& bytes) {
  std::vector<int> shades;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    int n = byte & 15;
    if (n == 15) {
      n = static_cast<unsigned char>(bytes.at(i + 1)) | static_cast<unsigned char>(bytes.at(i + 2)) << 8;
      i += 2;
    }
    shades.insert(shades.end(), static_cast<std::size_t>(n) + 1, byte >> 4);
  }
  return shades;
}

TEST(TileCodecTest, DecodesToTheShadesOfEveryCell) {
  const bool held = rc::check("tiles survive coding", [] {
    auto grid = common::makeOccupancyGrid(0.05);
    const auto runs = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(1, 900), rc::gen::inRange(-128, 101)));
    int at = 0;
    for (const auto& [length, value] : runs)
      for (int i = 0; i < length && at < kTile * kTile; ++i, ++at)
        grid.set({at % kTile - kTile, at / kTile}, static_cast<Cell>(value));
    const std::vector<int> shades = decodeTile(encodeTile(grid, {-kTile, 0}));
    RC_ASSERT(shades.size() == static_cast<std::size_t>(kTile) * kTile);
    for (int i = 0; i < kTile * kTile; ++i)
      RC_ASSERT(shades[static_cast<std::size_t>(i)] == shadeOf(grid.at({i % kTile - kTile, i / kTile})));
  });
  EXPECT_TRUE(held);
}

TEST(TileCodecTest, ShadesDistinguishFreeOccupiedAndUnknown) {
  EXPECT_EQ(shadeOf(common::occupancy::kUnknown), 0);
  for (int c = -100; c <= 100; ++c) {
    const int shade = shadeOf(static_cast<Cell>(c));
    EXPECT_EQ(shade >= 5, common::occupancy::isOccupied(static_cast<Cell>(c))) << c;
    EXPECT_GE(shade, 1);
    EXPECT_LE(shade, 8);
  }
}

/// The state of a page after the messages.
struct Page {
  std::map<std::pair<int, int>, std::vector<int>> tiles;

  void take(const std::string& m) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(m.at(i)); };
    const auto i16 = [&](std::size_t i) { return static_cast<std::int16_t>(byte(i) | byte(i + 1) << 8); };
    ASSERT_EQ(byte(0), 1);
    if (byte(1) == 1) tiles.clear();
    std::size_t at = 8;
    for (int n = i16(2); n > 0; --n) {
      const auto length = static_cast<std::uint16_t>(i16(at + 4));
      tiles[{i16(at), i16(at + 2)}] = decodeTile(m.substr(at + 6, length));
      at += 6u + length;
    }
    ASSERT_EQ(at, m.size());
  }
  int shadeAt(common::CellIndex c) const {
    const int tx = static_cast<int>(std::floor(static_cast<double>(c.x) / kTile));
    const int ty = static_cast<int>(std::floor(static_cast<double>(c.y) / kTile));
    const auto it = tiles.find({tx, ty});
    return it == tiles.end() ? 0
                             : it->second.at(static_cast<std::size_t>((c.y - ty * kTile) * kTile + c.x - tx * kTile));
  }
};

TEST(TileFeedTest, APageThatReadsAllMessagesHasTheMapWheneverItJoins) {
  testing::ExampleFlight flight;
  TileFeed feed;
  TileReader early(TileReader::Map::kFlown), late(TileReader::Map::kFlown);
  Page early_page, late_page;
  std::shared_ptr<const common::World> world;
  for (int i = 0; i < 8; ++i) {
    world = flight.advance(1.0);
    feed.update(world->map->grid);
    for (std::string m = early.next(feed, 1000); !m.empty(); m = early.next(feed, 1000)) early_page.take(m);
  }
  for (std::string m = late.next(feed, 1000); !m.empty(); m = late.next(feed, 1000)) late_page.take(m);
  world->map->grid->forEachCell([&](common::CellIndex c, Cell value) {
    ASSERT_EQ(early_page.shadeAt(c), shadeOf(value));
    ASSERT_EQ(late_page.shadeAt(c), shadeOf(value));
  });
}

TEST(TileFeedTest, TilesRemovedFromTheMapAreRemovedFromThePage) {
  auto first = common::makeOccupancyGrid(0.05), second = common::makeOccupancyGrid(0.05);
  first.set({500, 3}, 50);
  second.set({0, 0}, 50);
  TileFeed feed;
  TileReader reader(TileReader::Map::kFlown);
  Page page;
  feed.update(std::make_shared<const common::OccupancyGrid>(first));
  page.take(reader.next(feed, 1000));
  EXPECT_GE(page.shadeAt({500, 3}), 5);
  feed.update(std::make_shared<const common::OccupancyGrid>(second));
  page.take(reader.next(feed, 1000));
  EXPECT_EQ(page.shadeAt({500, 3}), 0);
  EXPECT_GE(page.shadeAt({0, 0}), 5);
  EXPECT_TRUE(reader.next(feed, 1000).empty());
}

TEST(TileFeedTest, UnchangedShadesSendNothing) {
  auto grid = common::makeOccupancyGrid(0.05);
  grid.set({3, 3}, 99);
  TileFeed feed;
  TileReader reader(TileReader::Map::kFlown);
  feed.update(std::make_shared<const common::OccupancyGrid>(grid.snapshot()));
  EXPECT_FALSE(reader.next(feed, 1000).empty());
  grid.set({3, 3}, 100);
  feed.update(std::make_shared<const common::OccupancyGrid>(grid.snapshot()));
  EXPECT_TRUE(reader.next(feed, 1000).empty());
}

TEST(CommandDeskTest, ReturnsEachAnswerToItsSender) {
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
  CommandDesk desk(commands, results, 3);
  std::vector<std::string> log;
  const auto note = [&log](std::uint64_t id, const std::optional<common::CommandResult>& result) {
    log.push_back(std::to_string(id) + (result ? result->accepted ? " yes" : " no: " + result->reason : " silence"));
  };
  ASSERT_TRUE(desk.give(common::HoldCommand{}, note));
  ASSERT_TRUE(desk.give(common::HomeCommand{}, note));
  ASSERT_TRUE(desk.give(common::LandCommand{}, note));
  const auto asked = commands.takeAll();
  ASSERT_EQ(asked.size(), 3u);
  results.push({asked[1].id, false, "no home"});
  results.push({asked[0].id, true, ""});
  results.push({99, true, ""});
  desk.tick();
  EXPECT_TRUE(desk.waiting());
  desk.tick();
  desk.tick();
  EXPECT_FALSE(desk.waiting());
  EXPECT_EQ(log, (std::vector<std::string>{"2 no: no home", "1 yes", "3 silence"}));
  results.push({asked[2].id, true, ""});
  desk.tick();
  EXPECT_EQ(log.size(), 3u);
}

TEST(CommandDeskTest, LimitsTheWaitingCommands) {
  common::LosslessQueue<common::OperatorCommand> commands;
  common::LosslessQueue<common::CommandResult> results;
  CommandDesk desk(commands, results, 1000);
  int given = 0;
  for (int i = 0; i < 1000; ++i)
    given += desk.give(common::HoldCommand{}, [](std::uint64_t, const std::optional<common::CommandResult>&) {});
  EXPECT_EQ(given, 64);
  EXPECT_EQ(commands.takeAll().size(), 64u);
}

TEST(StateJsonTest, ContainsEverythingAndIsValidJson) {
  testing::ExampleFlight flight;
  flight.flyTo({1.0, 0.5});
  const auto world = flight.advance(0.5);
  const std::vector<NumberedEvent> events{
      {7, {common::Time::fromSeconds(1.5), common::Severity::kWarning, "web", "a", "b"}}};
  const auto json = nlohmann::json::parse(completeJson(*world, {}, events));
  EXPECT_NEAR(json["pose"]["x_m"], world->vehicle->state.T_map_body_planar().x_m, 1e-3);
  EXPECT_EQ(json["flight_state"], "flying");
  EXPECT_EQ(json["goal"]["x_m"], 1.0);
  EXPECT_EQ(json["trail"].size(), world->vehicle->trail.points_map_m().size());
  EXPECT_EQ(json["frontiers"].size(), world->map->frontiers->size());
  EXPECT_EQ(json["frontiers"][1]["reason"], "unreachable");
  EXPECT_EQ(json["levels"][0]["height_m"], 0.76);
  EXPECT_EQ(json["mission"]["tree"][1]["name"], "AvoidObstacle");
  EXPECT_EQ(json["events"][0]["number"], 7);
  EXPECT_TRUE(json["localization"].is_null());
}

TEST(StateJsonTest, ContainsThePoseInTheGivenMapOnceItIsKnown) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(0.5));
  common::Localization& localization = layers.map.localization.emplace();
  localization.state = common::LocalizationState::kAmbiguous;
  localization.places = 3;
  localization.candidates = {{{1.0, 0.5, 0.2}, 0.6}, {{-2.0, 0.5, 3.0}, 0.25}};
  const auto unknown = nlohmann::json::parse(completeJson(layers.world(), {}, {}))["localization"];
  EXPECT_EQ(unknown["state"], "ambiguous");
  EXPECT_EQ(unknown["places"], 3);
  EXPECT_TRUE(unknown["x_m"].is_null());
  EXPECT_TRUE(unknown["T_map_given"].is_null());
  ASSERT_EQ(unknown["candidates"].size(), 2u);
  EXPECT_EQ(unknown["candidates"][1]["x_m"], -2.0);
  EXPECT_EQ(unknown["candidates"][1]["weight"], 0.25);
  localization.candidates.clear();
  layers.map.T_map_given = common::Pose2{1.0, 2.0, -0.5};
  localization.state = common::LocalizationState::kLocalized;
  localization.T_given_body = {3.0, -1.5, 0.5};
  localization.covariance.diagonal() << 0.0009, 0.0016, 0.01;
  localization.explained = 0.875;
  const auto known = nlohmann::json::parse(completeJson(layers.world(), {}, {}))["localization"];
  EXPECT_EQ(known["y_m"], -1.5);
  EXPECT_EQ(known["yaw_rad"], 0.5);
  EXPECT_EQ(known["deviation_m"], 0.05);
  EXPECT_EQ(known["explained"], 0.875);
  EXPECT_EQ(known["deviation_yaw_rad"], 0.1);
  EXPECT_EQ(known["T_map_given"]["yaw_rad"], -0.5);
}

/// A flight at any speed that the telemetry observes only when the test asks for it.
class RealtimeFactor : public ::testing::Test {
 protected:
  /// The realtime factor in the state after another `unix_s` seconds, flown at `speed` times real time.
  nlohmann::json after(double unix_s, double speed) {
    unix_time_ = unix_time_ + common::Duration::fromSeconds(unix_s);
    world_.post(flight_.advance(speed * unix_s));
    telemetry_.look();
    return nlohmann::json::parse(stateJson(*telemetry_.world().value, telemetry_.observe()))["realtime_factor"];
  }
  testing::ExampleFlight flight_;
  common::LatestValue<common::World> world_;
  common::LatestValue<common::CameraFrame> camera_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  common::LosslessQueue<common::CommandResult> results_;
  common::Time unix_time_ = common::Time::fromSeconds(1.8e9);
  Telemetry telemetry_{{world_, camera_, commands_, results_}, [this] { return unix_time_; }};
};

TEST_F(RealtimeFactor, IsUnknownAtFirstAndThenThatOfTheLastSeconds) {
  EXPECT_TRUE(after(0.1, 4.0).is_null());
  for (int i = 0; i < 20; ++i) after(0.1, 4.0);
  EXPECT_NEAR(after(0.1, 4.0).get<double>(), 4.0, 0.01);
  for (int i = 0; i < 40; ++i) after(0.1, 0.5);
  EXPECT_NEAR(after(0.1, 0.5).get<double>(), 0.5, 0.01);
}

TEST_F(RealtimeFactor, IsKnownRightAfterAPauseBetweenRequests) {
  for (int i = 0; i < 20; ++i) after(0.1, 2.0);
  EXPECT_NEAR(after(10.0, 2.0).get<double>(), 2.0, 0.01);
  EXPECT_NEAR(after(0.1, 2.0).get<double>(), 2.0, 0.01);
  EXPECT_NEAR(after(0.02, 2.0).get<double>(), 2.0, 0.01);
}

TEST_F(RealtimeFactor, IsThatOfTheLastSecondsAlsoAfterTheClockWasSetBack) {
  for (int i = 0; i < 20; ++i) after(0.1, 4.0);
  unix_time_ = unix_time_ - common::Duration::fromSeconds(3600.0);
  for (int i = 0; i < 20; ++i) after(0.1, 2.0);
  EXPECT_NEAR(after(0.1, 2.0).get<double>(), 2.0, 0.01);
}

TEST_F(RealtimeFactor, ASilentVehicleIsSilentAlsoAfterTheClockWasSetBack) {
  after(0.1, 1.0);
  unix_time_ = unix_time_ - common::Duration::fromSeconds(3600.0);
  telemetry_.look();
  unix_time_ = unix_time_ + common::Duration::fromSeconds(5.0);
  telemetry_.look();
  EXPECT_NEAR(telemetry_.observe().world_age_s, 5.0, 1e-6);
}

TEST(StateJsonTest, NamesTheVehicleOnlyWhereThereAreSeveral) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(0.1));
  std::vector<NumberedEvent> events{{1, {layers.stamp, common::Severity::kInfo, "mission", "ready", ""}}};
  const auto alone = nlohmann::json::parse(completeJson(layers.world(), {}, events));
  EXPECT_FALSE(alone.contains("vehicle"));
  EXPECT_FALSE(alone["events"][0].contains("vehicle"));
  layers.vehicle.name = events[0].event.vehicle = "second";
  const auto named = nlohmann::json::parse(completeJson(layers.world(), {}, events));
  EXPECT_EQ(named["vehicle"], "second");
  EXPECT_EQ(named["events"][0]["vehicle"], "second");
}

TEST(StateJsonTest, TellsWhatIsLeftToFlyWithOnceItIsKnown) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(0.1));
  layers.vehicle.drift_m = 0.42;
  layers.energy.seconds_left = 399.2;
  layers.energy.thrust_margin = 1.345;
  auto state = nlohmann::json::parse(stateJson(layers.world(), {}));
  EXPECT_DOUBLE_EQ(state["drift_m"].get<double>(), 0.42);
  EXPECT_DOUBLE_EQ(state["battery"]["left_s"].get<double>(), 399.0);
  EXPECT_NEAR(state["thrust_margin"].get<double>(), 1.345, 0.006);
  layers.energy.seconds_left.reset();
  layers.energy.thrust_margin = 0.0;
  state = nlohmann::json::parse(stateJson(layers.world(), {}));
  EXPECT_TRUE(state["battery"]["left_s"].is_null());
  EXPECT_TRUE(state["thrust_margin"].is_null());
}

TEST(StateJsonTest, TellsTheAgeOfTheFused3DMap) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(0.1));
  auto map3d = std::make_shared<common::Map3dLayer>();
  map3d->submaps = std::make_shared<const std::vector<common::Submap3d>>();
  layers.map3d = map3d;
  EXPECT_TRUE(nlohmann::json::parse(stateJson(layers.world(), {}))["map3d"]["fused_age_s"].is_null());
  map3d = std::make_shared<common::Map3dLayer>(*map3d);
  map3d->fused = std::make_shared<const common::VoxelMap>(0.05);
  map3d->fused_stamp = layers.world().stamp - common::Duration::fromSeconds(3.5);
  layers.map3d = map3d;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(stateJson(layers.world(), {}))["map3d"]["fused_age_s"].get<double>(), 3.5);
}

TEST(StateJsonTest, StaysValidWithNanAndInvalidText) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(0.1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  layers.vehicle.state.T_odom_body.position_m.setConstant(nan);
  layers.vehicle.state.T_odom_body.rotation.coeffs().setConstant(nan);
  layers.energy.battery_voltage_v = nan;
  layers.vehicle.avoidance.nearest_m = std::numeric_limits<double>::infinity();
  layers.vehicle.plan_map_m = {{nan, 1e300}};
  layers.mission.status.phase = "bad \xff\xc3 text \n\x01";
  const auto json = nlohmann::json::parse(completeJson(layers.world(), {}, {}));
  EXPECT_TRUE(json["pose"]["x_m"].is_null());
  EXPECT_TRUE(json["avoidance"]["nearest_m"].is_null());
  EXPECT_TRUE(json["plan"][0][0].is_null());
}

}  // namespace
}  // namespace swiftlet::web
