// A flight is a function of its inputs: recorded in memory and given to another autonomy, they give the same flight
// again.
#include "autonomy/loop/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "autonomy/loop/flight_loop.hpp"
#include "common/mailbox.hpp"
#include "common/rgbd_frame.hpp"
#include "common/world/map3d_layer.hpp"
#include "tests/flight_loop/short_flight.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::JobDelivery;
using common::Time;

/// One flight from the ground to the ground in lockstep. Before each step, `order` may give the operator's commands.
struct Recorded {
  using Commands = common::LosslessQueue<common::OperatorCommand>;

  template <typename Vehicle, typename Order>
  Recorded(Vehicle& vehicle, const Order& order) {
    Autonomy autonomy = makeAutonomy(common::makeLockstepJobs(1));
    Commands commands;
    InputRecorder recorder;
    FlightLoop loop(vehicle, autonomy, commands, {&recorder, &witness});
    while (!autonomy.finished() && loop.now() < Time::fromSeconds(60)) {
      order(loop.now(), commands);
      if (!loop.step(loop.now() + common::kControlPeriod)) break;
    }
    finished = autonomy.finished();
    recording = recorder.recording();
  }

  Witness witness;
  Recording recording;
  bool finished = false;
};

Recorded flyWithAGoal() {
  const auto vehicle = makeVehicle(12);
  vehicle->setCameraConsumer(true);
  return {*vehicle, [](Time now, Recorded::Commands& commands) {
            if (now == Time::fromSeconds(9)) commands.push({1, common::GoalCommand{{1.0, 0.0}}});
          }};
}

/// Flown once for all tests.
const Recorded& flown() {
  static const Recorded kFlown = flyWithAGoal();
  return kFlown;
}

std::map<std::string, int> deliveriesByKind(const Recording& recording) {
  std::map<std::string, int> counts;
  for (const Input& input : recording)
    if (const auto* delivery = std::get_if<JobDelivery>(&input)) ++counts[delivery->kind];
  return counts;
}

template <typename Frame>
int countOf(const Recording& recording) {
  return static_cast<int>(std::count_if(recording.begin(), recording.end(), [](const Input& input) {
    const auto* event = std::get_if<common::SensorEvent>(&input);
    return event && std::holds_alternative<std::shared_ptr<const Frame>>(*event);
  }));
}

TEST(Recording, ContainsAFlightWithEveryKindOfInput) {
  ASSERT_TRUE(flown().finished);
  EXPECT_TRUE(flown().witness.heard("flying"));
  auto counts = deliveriesByKind(flown().recording);
  EXPECT_GE(counts["planning"], 3);
  EXPECT_GE(counts["slam"], 1);
  EXPECT_GT(countOf<common::LaserScan>(flown().recording), 300);
  EXPECT_GT(countOf<common::CameraFrame>(flown().recording), 100) << "frames are recorded like scans";
  EXPECT_EQ(flown().witness.results.size(), 1u);

  Time last;
  for (const Input& input : flown().recording) {
    EXPECT_GE(timeOf(input), last) << "no input is of a time before the last one";
    last = timeOf(input);
  }
}

TEST(Recording, RepeatsTheFlight) {
  Autonomy again = makeAutonomy(common::makeLockstepJobs(0));
  Witness witness;
  const auto outcome = replay(flown().recording, again, {&witness});
  ASSERT_TRUE(outcome) << outcome.error();
  ASSERT_FALSE(witness.ticks.empty());
  EXPECT_EQ(difference(flown().witness, witness), "");
  EXPECT_TRUE(again.finished());
}

/// Where the deliveries of a kind are.
std::vector<std::size_t> deliveriesOf(const Recording& recording, const std::string& kind) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < recording.size(); ++i)
    if (const auto* one = std::get_if<JobDelivery>(&recording[i]); one && one->kind == kind) found.push_back(i);
  return found;
}

/// The same inputs, but one delivery comes a second later.
Recording withOneDeliveryShifted(Recording recording, std::size_t at) {
  JobDelivery shifted = std::get<JobDelivery>(recording[at]);
  shifted.delivered += Duration::fromSeconds(1);
  recording.erase(recording.begin() + static_cast<std::ptrdiff_t>(at));
  const auto later = std::find_if(recording.begin(), recording.end(),
                                  [&](const Input& input) { return timeOf(input) >= shifted.delivered; });
  recording.insert(later, shifted);
  return recording;
}

bool isDetected(std::size_t shifted_delivery) {
  Autonomy again = makeAutonomy(common::makeLockstepJobs(0));
  Witness witness;
  const auto outcome = replay(withOneDeliveryShifted(flown().recording, shifted_delivery), again, {&witness});
  if (outcome) return !difference(flown().witness, witness).empty();
  EXPECT_THAT(outcome.error(), testing::HasSubstr("not outstanding"));
  return true;
}

/// A job of the SLAM whose result changes nothing may come at any time, so the first one that matters is sought.
TEST(Recording, AShiftedDeliveryIsDetected) {
  for (const std::string kind : {"planning", "slam"}) {
    const std::vector<std::size_t> deliveries = deliveriesOf(flown().recording, kind);
    EXPECT_TRUE(std::any_of(deliveries.begin(), deliveries.end(), isDetected)) << kind;
  }
}

/// The first seconds of a flight with an RGB-D camera, whose poses enter the state.
TEST(Recording, RepeatsAFlightThatMapsIn3D) {
  common::RgbdCameraConfig camera;
  camera.width_px = 160;
  camera.height_px = 120;
  Witness witness;
  InputRecorder recorder;
  const auto vehicle = makeVehicle(12, &camera);
  Autonomy autonomy = makeAutonomy(common::makeLockstepJobs(1), {}, nullptr, &camera);
  common::LosslessQueue<common::OperatorCommand> commands;
  FlightLoop loop(*vehicle, autonomy, commands, {&recorder, &witness});
  while (loop.now() < Time::fromSeconds(7))
    if (!loop.step(loop.now() + common::kControlPeriod)) break;
  ASSERT_TRUE(autonomy.world()->map3d);
  EXPECT_GT(countOf<common::RgbdFrame>(recorder.recording()), 80);
  EXPECT_GT(deliveriesByKind(recorder.recording())["mapping3d"], 70);

  Autonomy again = makeAutonomy(common::makeLockstepJobs(0), {}, nullptr, &camera);
  Witness repeated;
  ASSERT_TRUE(replay(recorder.recording(), again, {&repeated}));
  EXPECT_EQ(difference(witness, repeated), "");
  const auto &submaps = *autonomy.world()->map3d->submaps, &same = *again.world()->map3d->submaps;
  ASSERT_EQ(submaps.size(), same.size());
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    ASSERT_EQ(submaps[i].points->size(), same[i].points->size());
    for (std::size_t k = 0; k < submaps[i].points->size(); ++k)
      ASSERT_EQ((*submaps[i].points)[k].position_m, (*same[i].points)[k].position_m);
  }
}

std::string aMissionOf(const std::string& leaves) {
  return R"(<root BTCPP_format="4"><BehaviorTree ID="Other"><Sequence>)" + leaves + "</Sequence></BehaviorTree></root>";
}

/// A flight whose mission is changed twice: once to one that cannot be flown, once to another one. The inputs end with
/// the landing of the second mission.
Recorded flyWithChanges() {
  const auto vehicle = makeVehicle(13);
  return {*vehicle, [](Time now, Recorded::Commands& commands) {
            if (now == Time::fromSeconds(7))
              commands.push({1, common::StartMissionCommand{"broken.xml", aMissionOf("<Fly/>")}});
            if (now == Time::fromSeconds(8))
              commands.push({2, common::StartMissionCommand{
                                    "other.xml", aMissionOf("<TakeOff/><MoveToGoal goal=\"0.6;0.2;1.2\"/><Land/>")}});
          }};
}

TEST(Recording, RepeatsAFlightWhoseMissionIsChanged) {
  const Recorded flown = flyWithChanges();
  ASSERT_TRUE(flown.finished);
  ASSERT_EQ(flown.witness.results.size(), 2u);
  EXPECT_FALSE(flown.witness.results[0].accepted);
  EXPECT_TRUE(flown.witness.results[1].accepted) << flown.witness.results[1].reason;
  EXPECT_NEAR(flown.witness.ticks.back().state.T_map_body().position_m.x(), 0.6, 0.15) << "flown to its goal";

  Witness again, with_another;
  Autonomy same = makeAutonomy(common::makeLockstepJobs(0));
  const auto outcome = replay(flown.recording, same, {&again});
  ASSERT_TRUE(outcome) << outcome.error();
  EXPECT_EQ(difference(flown.witness, again), "");
  EXPECT_TRUE(same.finished());

  // The text of the command is the mission that is flown: with another text it is another flight.
  Recording changed = flown.recording;
  for (Input& input : changed)
    if (auto* command = std::get_if<CommandInput>(&input))
      if (auto* start = std::get_if<common::StartMissionCommand>(&command->command.kind))
        start->xml = aMissionOf("<TakeOff/><Land/>");
  Autonomy other = makeAutonomy(common::makeLockstepJobs(0));
  if (replay(changed, other, {&with_another})) {
    EXPECT_NE(difference(flown.witness, with_another), "");
  }
}

/// A mission from the page brings the map that it loads; once the vehicle knows its place there, the operator sends it
/// to a place of that map.
void flyInAMapOfThePage(Witness& witness, InputRecorder& recorder, const common::GivenMap& map) {
  const auto vehicle = makeVehicle(13);
  Autonomy autonomy = makeAutonomy(common::makeLockstepJobs(1));
  common::LosslessQueue<common::OperatorCommand> commands;
  FlightLoop loop(*vehicle, autonomy, commands, {&recorder, &witness});
  commands.push({1, common::StartMissionCommand{
                        "with_map.xml",
                        aMissionOf("<TakeOff/><LoadMap file=\"page.yaml\"/><Localize/><OperatorCommand/>"),
                        {{"page.yaml", map}}}});
  bool sent = false;
  Time end = Time::fromSeconds(45);
  while (loop.now() < end && loop.step(loop.now() + common::kControlPeriod)) {
    const auto& T_map_given = autonomy.world()->map->T_map_given;
    if (!T_map_given || std::exchange(sent, true)) continue;
    commands.push({2, common::GoalCommand{{}, T_map_given->inverse() * Eigen::Vector2d(0.5, 0.3)}});
    end = loop.now() + Duration::fromSeconds(4);
  }
}

TEST(Recording, RepeatsAFlightInAMapThatAMissionBrought) {
  const common::GivenMap map{flown().witness.last_world->map->grid, {4.0, -2.0, 0.8}, 7};
  Witness witness;
  InputRecorder recorder;
  flyInAMapOfThePage(witness, recorder, map);
  ASSERT_FALSE(witness.results.empty());
  ASSERT_TRUE(witness.results[0].accepted) << witness.results[0].reason;
  ASSERT_EQ(witness.results.size(), 2u) << "it has not found its place";
  EXPECT_TRUE(witness.results[1].accepted) << witness.results[1].reason;
  ASSERT_TRUE(witness.last_world->map->T_map_given);

  Autonomy again = makeAutonomy(common::makeLockstepJobs(0));
  Witness same;
  const auto outcome = replay(recorder.recording(), again, {&same});
  ASSERT_TRUE(outcome) << outcome.error();
  EXPECT_EQ(difference(witness, same), "");
  EXPECT_EQ(witness.last_world->map->T_map_given->x_m, same.last_world->map->T_map_given->x_m);

  // The map and the goal are those of the commands: with others it is another flight.
  const auto differs = [&](const auto& change) {
    Recording changed = recorder.recording();
    for (Input& input : changed)
      if (auto* command = std::get_if<CommandInput>(&input)) change(command->command);
    Autonomy other = makeAutonomy(common::makeLockstepJobs(0));
    Witness another;
    return !replay(changed, other, {&another}) || !difference(witness, another).empty();
  };
  EXPECT_TRUE(differs([](common::OperatorCommand& command) {
    if (auto* start = std::get_if<common::StartMissionCommand>(&command.kind)) start->maps.clear();
  }));
  EXPECT_TRUE(differs([](common::OperatorCommand& command) {
    if (auto* goal = std::get_if<common::GoalCommand>(&command.kind)) goal->goal_given_m->x() += 0.3;
  }));
}

/// The first seconds of a flight that starts from what another one has learned.
TEST(Recording, RepeatsAFlightWithAVehiclesMemoryOnlyWithThatMemory) {
  VehicleMemory memory{VehicleMemory::kVersion, "cobra", {{10.0, 0.98, 30.0}, {12.6, 0.62, 30.0}}};
  Witness witness;
  InputRecorder recorder;
  Autonomy autonomy = makeAutonomy(common::makeLockstepJobs(1), {}, &memory);
  {
    const auto vehicle = makeVehicle(12);
    common::LosslessQueue<common::OperatorCommand> commands;
    FlightLoop loop(*vehicle, autonomy, commands, {&recorder, &witness});
    while (loop.now() < Time::fromSeconds(8)) ASSERT_TRUE(loop.step(loop.now() + common::kControlPeriod));
  }
  Witness with, without;
  Autonomy again = makeAutonomy(common::makeLockstepJobs(0), {}, &memory);
  ASSERT_TRUE(replay(recorder.recording(), again, {&with}));
  EXPECT_EQ(difference(witness, with), "");
  const auto known = autonomy.learned().thrust, known_again = again.learned().thrust;
  ASSERT_EQ(known.size(), known_again.size());
  for (std::size_t i = 0; i < known.size(); ++i) EXPECT_EQ(known[i].hover_command, known_again[i].hover_command);

  Autonomy fresh = makeAutonomy(common::makeLockstepJobs(0), AutonomyConfig{});
  if (replay(recorder.recording(), fresh, {&without})) {
    EXPECT_NE(difference(witness, without), "");
  }
}

TEST(Recording, ARecordingOfAnotherFlightIsRefusedWithThePlace) {
  Autonomy fresh = makeAutonomy(common::makeLockstepJobs(0));
  const JobDelivery stray{"planning", 7, Time::fromSeconds(1), Time::fromSeconds(2)};
  const auto outcome = replay({Tick{Time::fromSeconds(0.01)}, stray}, fresh, {});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error(),
            "at 2.000 s the recording delivers job 7 (planning) of 1.000 s, which is not outstanding in the replay");
}

}  // namespace
}  // namespace swiftlet::autonomy
