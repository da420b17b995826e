// Worlds from the data sets: they load, and the vehicle can fly in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "fixtures.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/truth_map.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::simulation {
namespace {

struct Case {
  const char* archive;
  const char* world;
  double start_x_m, start_y_m;
  double least_area_m2;  ///< Reachable at 1 m.
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.world; }

class WorldOfDataSet : public ::testing::TestWithParam<Case> {};

TEST_P(WorldOfDataSet, LoadsAndAllowsAFlight) {
  const auto archive = test_support::dataSet(std::string("06-sim-worlds/") + GetParam().archive);
  if (!archive) return;
  const TemporaryFolder folder("swiftlet_datasets");
  ASSERT_EQ(std::system(("tar -xJf '" + archive->string() + "' -C '" + folder.path().string() + "'").c_str()), 0);

  ::testing::internal::CaptureStderr();
  const WorldModel world = loadWorld((folder.path() / GetParam().world).string());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  Scenario scenario;
  scenario.start.from_world = false;
  scenario.start.x_m = GetParam().start_x_m;
  scenario.start.y_m = GetParam().start_y_m;
  SimulatedVehicle vehicle(world, scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(GetParam().start_x_m, GetParam().start_y_m, 1.0);
  EXPECT_TRUE(pilot.fly(4.0)) << vehicle.stopReason();
  EXPECT_NEAR(vehicle.truth().T_world_body.position_m.z() - vehicle.T_world_map().position_m.z(), 1.0, 0.1);

  FreeSpaceQuery query;
  query.start_world_m = {GetParam().start_x_m, GetParam().start_y_m};
  query.bottom_m = vehicle.T_world_map().position_m.z() + 0.875;
  query.top_m = query.bottom_m + 0.25;
  query.resolution_m = 0.1;
  query.max_area_m2 = 500.0;
  double cells = 0.0;
  reachableSpace(vehicle.rays(), query).forEachCell([&](common::CellIndex, std::uint8_t cell) { cells += cell; });
  EXPECT_GT(cells * 0.01, GetParam().least_area_m2);
  RecordProperty("reachable_m2", std::to_string(cells * 0.01));
}

INSTANTIATE_TEST_SUITE_P(
    Datasets, WorldOfDataSet,
    ::testing::Values(
        Case{"turtlebot3_house_and_world/turtlebot3_house_and_world.tar.xz", "worlds/turtlebot3_house.world", -3.0, 1.0,
             60.0},
        Case{"turtlebot3_house_and_world/turtlebot3_house_and_world.tar.xz", "worlds/turtlebot3_world.world", -2.0,
             -0.5, 5.0},
        Case{"hector_small_indoor/hector_small_indoor.tar.xz", "worlds/small_indoor_scenario.world", -3.0, 1.0, 20.0},
        Case{"aws_small_house/aws_small_house.tar.xz", "worlds/small_house.world", 0.0, 0.0, 20.0},
        Case{"aws_small_warehouse/aws_small_warehouse.tar.xz", "worlds/small_warehouse.world", 0.0, 0.0, 50.0},
        Case{"aws_small_warehouse/aws_small_warehouse.tar.xz", "worlds/no_roof_small_warehouse.world", 0.0, 0.0, 50.0},
        Case{"gz_cafe/gz_cafe.tar.xz", "cafe/model.sdf", 0.0, 0.0, 50.0}));

}  // namespace
}  // namespace swiftlet::simulation
