// Support for stories of the whole autonomy: a simulated vehicle in a room, and a hook that may drop or change sensor
// events before the autonomy gets them.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_loop.hpp"
#include "autonomy/loop/flight_sink.hpp"
#include "autonomy/requests/run_files.hpp"
#include "common/config.hpp"
#include "common/mailbox.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "tests/simulation/fixtures.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::MissionState;

/// A vehicle with a hook on its sensor events and one on its setpoints. The hook may change an event, or drop it
/// (false).
class HandledVehicle final : public common::Vehicle {
 public:
  using Hand = std::function<bool(common::SensorEvent&)>;
  /// Refers to both arguments.
  HandledVehicle(common::Vehicle& vehicle, const Hand& hand, const double& thrust_share)
      : vehicle_(vehicle), hand_(hand), thrust_share_(thrust_share) {}

  common::Time now() const override { return vehicle_.now(); }
  bool advanceTo(common::Time time, std::vector<common::SensorEvent>& events) override {
    const bool alive = vehicle_.advanceTo(time, events);
    std::erase_if(events, [this](common::SensorEvent& event) { return !hand_(event); });
    return alive;
  }
  void apply(const common::Setpoint& setpoint) override {
    common::Setpoint weaker = setpoint;
    weaker.thrust *= thrust_share_;
    vehicle_.apply(weaker);
  }
  std::string stopReason() const override { return vehicle_.stopReason(); }

 private:
  common::Vehicle& vehicle_;
  const Hand& hand_;
  const double& thrust_share_;
};

/// The room, the vehicle and the frame of a mission that the stories share.
inline simulation::WorldModel storyRoom() {
  simulation::WorldModel world = simulation::boxRoom();
  world.shapes.push_back(simulation::boxShape("cupboard", {2.5, 2.5, 0}, {3.5, 3.3, 2.5}));
  world.shapes.push_back(simulation::boxShape("shelf", {-4.9, -1.0, 0}, {-4.4, 1.0, 2.5}));
  return world;
}
inline simulation::Scenario storyScenario(const common::RgbdCameraConfig* camera = nullptr) {
  using common::config::readFile;
  simulation::Scenario scenario;
  scenario.seed = 1;
  scenario.start.from_world = false;
  scenario.vehicle = readFile<common::VehicleConfig>(SWIFTLET_SOURCE_DIR "/config/vehicles/cobra.yaml");
  scenario.laser = readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/utm_30lx.yaml");
  if (camera != nullptr) scenario.rgbd_camera = *camera;
  return scenario;
}
/// `leaves` are flown one after the other, below AvoidObstacle and Hold.
inline behaviors::Mission storyMission(const std::string& leaves) {
  return behaviors::Mission::fromText(
      R"(<root BTCPP_format="4" main_tree_to_execute="Story"><BehaviorTree ID="Story"><Priority>)"
      "<AvoidObstacle/><Hold/><Sequence>" +
          leaves + "</Sequence></Priority></BehaviorTree></root>",
      "story.xml");
}

class AutonomyStory {
 public:
  /// `leaves` as for storyMission; without `camera` the vehicle has none.
  explicit AutonomyStory(const std::string& leaves, const GivenMap* given = nullptr,
                         const common::RgbdCameraConfig* camera = nullptr)
      : AutonomyStory(storyMission(leaves), given, camera) {}
  explicit AutonomyStory(behaviors::Mission mission, const GivenMap* given = nullptr,
                         const common::RgbdCameraConfig* camera = nullptr)
      : vehicle_(storyRoom(), storyScenario(camera)),
        autonomy_({.vehicle = vehicle_.scenario().vehicle,
                   .laser = vehicle_.scenario().laser,
                   .mission = std::move(mission),
                   .jobs = common::makeLockstepJobs(0),
                   .given = given,
                   .camera = camera}) {}

  double thrust_share = 1.0;  ///< Of each commanded thrust that reaches the motors.
  /// Is called with every sensor event before the autonomy gets it; false drops the event.
  HandledVehicle::Hand hand = [](common::SensorEvent&) { return true; };

  [[nodiscard]] bool tick() { return loop_.step(vehicle_.now() + common::kControlPeriod); }
  /// False if it does not become true in time, or if the vehicle crashes.
  template <typename Condition>
  [[nodiscard]] bool until(Condition condition, double at_most_s) {
    const common::Time end = vehicle_.now() + common::Duration::fromSeconds(at_most_s);
    while (!condition())
      if (vehicle_.now() >= end || !tick()) return false;
    return true;
  }
  [[nodiscard]] bool fly(double seconds) {
    (void)until([] { return false; }, seconds);
    return vehicle_.stopReason().empty();
  }
  [[nodiscard]] bool isFlying() {
    return until([this] { return world().vehicle->flight_state == FlightState::kFlying; }, 15.0);
  }

  /// The answer, which may come with a later tick.
  template <typename Kind>
  common::CommandResult order(Kind kind) {
    const std::uint64_t id = ++orders_;
    commands_.push({id, kind});
    const auto answer = [&] {
      return std::find_if(results.begin(), results.end(), [&](const auto& result) { return result.id == id; });
    };
    EXPECT_TRUE(until([&] { return answer() != results.end(); }, 1.0)) << "no answer";
    return answer() == results.end() ? common::CommandResult{} : *answer();
  }

  const common::World& world() const { return *autonomy_.world(); }
  const Autonomy& autonomy() const { return autonomy_; }
  common::Time now() const { return vehicle_.now(); }
  /// The first event with that beginning; the end of the list if there is none.
  std::vector<common::Event>::const_iterator event(const std::string& source, const std::string& text) const {
    return std::find_if(events.begin(), events.end(),
                        [&](const auto& e) { return e.source == source && e.text.starts_with(text); });
  }

  std::vector<common::Event> events;
  std::vector<common::CommandResult> results;
  std::vector<RunFile> files;

 private:
  /// Collects the events of the flight.
  struct Listener final : FlightSink {
    explicit Listener(AutonomyStory& heard) : story(heard) {}
    void event(const common::Event& event) override { story.events.push_back(event); }
    void file(const RunFile& file) override { story.files.push_back(file); }
    void result(const common::CommandResult& result) override { story.results.push_back(result); }
    AutonomyStory& story;
  };

  simulation::SimulatedVehicle vehicle_;
  HandledVehicle handled_{vehicle_, hand, thrust_share};
  Autonomy autonomy_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  Listener listener_{*this};
  FlightLoop loop_{handled_, autonomy_, commands_, {&listener_}};
  std::uint64_t orders_ = 0;
};

}  // namespace swiftlet::autonomy
