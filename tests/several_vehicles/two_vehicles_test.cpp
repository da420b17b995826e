// Two vehicles with an autonomy each fly at the same time in one small world: past each other and home again.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_loop.hpp"
#include "autonomy/loop/flight_sink.hpp"
#include "behaviors/mission.hpp"
#include "common/config.hpp"
#include "common/mailbox.hpp"
#include "simulation/arena.hpp"
#include "tests/simulation/arena_fixtures.hpp"

namespace swiftlet {
namespace {

using common::Time;

std::string sequence(const std::string& leaves) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Flight\"><Sequence>" + leaves +
         "</Sequence></BehaviorTree></root>";
}

simulation::WorldModel furnishedRoom() {
  simulation::WorldModel world = simulation::boxRoom();
  world.shapes.push_back(simulation::boxShape("cupboard", {2.5, 3.0, 0}, {3.5, 3.8, 2.5}));
  world.shapes.push_back(simulation::boxShape("shelf", {-4.9, -1.0, 0}, {-4.4, 1.0, 2.5}));
  return world;
}

simulation::Scenario twoThatFaceEachOther() {
  auto scenario =
      simulation::scenarioOf({simulation::vehicleAt("alpha", -3, 0), simulation::vehicleAt("beta", 3, 0, 180)});
  scenario.seed = 7;
  scenario.vehicle = common::config::readFile<common::VehicleConfig>(SWIFTLET_SOURCE_DIR "/config/vehicles/cobra.yaml");
  scenario.laser = common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/utm_30lx.yaml");
  return scenario;
}

/// One vehicle and its autonomy, tick by tick.
class Flyer : private autonomy::FlightSink {
 public:
  Flyer(const std::shared_ptr<simulation::Arena>& arena, std::size_t index, const std::string& mission)
      : vehicle_(arena, index),
        autonomy_({.vehicle = vehicle_.scenario().vehicle,
                   .laser = vehicle_.scenario().laser,
                   .mission = behaviors::Mission::fromText(mission, "mission.xml"),
                   .jobs = common::makeLockstepJobs(1)}) {}

  void fly(Time now) {
    if (!loop_.step(now)) return;
    const common::Pose3 T_map_body = vehicle_.trueT_map_body();
    farthest_m_ = std::max(farthest_m_, T_map_body.position_m.x());
  }
  /// It is still advanced after its mission, because the other could not fly on otherwise.
  bool over() const { return vehicle_.truth().crashed || autonomy_.finished(); }

  const simulation::SimulatedVehicle& vehicle() const { return vehicle_; }
  const autonomy::Autonomy& autonomy() const { return autonomy_; }
  double farthest_m() const { return farthest_m_; }
  const std::string& story() const { return story_; }

 private:
  void event(const common::Event& event) override { story_ += event.source + ": " + event.text + "\n"; }

  simulation::SimulatedVehicle vehicle_;
  autonomy::Autonomy autonomy_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  autonomy::FlightLoop loop_{vehicle_, autonomy_, commands_, {this}};
  double farthest_m_ = 0.0;
  std::string story_;
};

TEST(TwoVehicles, PassEachOtherAndReturnHome) {
  const std::string there_and_back =
      sequence("<TakeOff/><MoveToGoal goal=\"5.0;0.0\" tolerance_m=\"0.15\"/><GoHome/><Land/>");
  const auto arena = std::make_shared<simulation::Arena>(furnishedRoom(), twoThatFaceEachOther());
  Flyer alpha(arena, 0, there_and_back), beta(arena, 1, there_and_back);
  Time now;
  while (now.seconds() < 150.0 && !(alpha.over() && beta.over())) {
    now += common::kControlPeriod;
    alpha.fly(now);
    beta.fly(now);
  }
  for (const Flyer* flyer : {&alpha, &beta}) {
    SCOPED_TRACE(flyer->vehicle().name() + "\n" + flyer->story());
    EXPECT_FALSE(flyer->vehicle().truth().crashed) << flyer->vehicle().stopReason();
    EXPECT_EQ(flyer->autonomy().missionStatus().state, common::MissionState::kDone)
        << flyer->autonomy().missionStatus().reason;
    EXPECT_GT(flyer->farthest_m(), 4.8) << "it came past the other";
    EXPECT_GT(flyer->vehicle().truth().min_vehicle_clearance_m, 0.05);
    EXPECT_FALSE(flyer->vehicle().truth().airborne);
    const common::Pose3 T_map_body = flyer->vehicle().trueT_map_body();
    EXPECT_LT(T_map_body.position_m.head<2>().norm(), 0.16);
  }
}

}  // namespace
}  // namespace swiftlet
