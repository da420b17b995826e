// What missions ask for beside intents: maps, photographs, and their answers.
#include "autonomy/requests/flight_requests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::autonomy {
namespace {

common::Time timeAt(double seconds) { return common::Time::fromSeconds(seconds); }

common::World worldAt(double seconds) {
  test::Layers layers;
  layers.stamp = timeAt(seconds);
  return layers.world();
}

std::shared_ptr<const common::RgbdFrame> frameAt(double seconds) {
  common::RgbdFrame frame;
  frame.stamps.measured = frame.stamps.arrived = timeAt(seconds);
  return std::make_shared<const common::RgbdFrame>(frame);
}

TEST(FlightRequests, SavesTheMapOfThePresentWorld) {
  common::EventLog log;
  FlightRequests requests(0.275, nullptr, log);
  const common::World world = worldAt(3.0);
  requests.take({5, common::SaveMapRequest{"hall"}}, world);
  EXPECT_TRUE(requests.takeAnswers(timeAt(3.0)).at(0).done);
  const auto files = requests.takeFiles();
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(std::get<SavedMap>(files[0]).name, "hall");
  EXPECT_EQ(std::get<SavedMap>(files[0]).grid, world.map->grid);
}

TEST(FlightRequests, PassesOnTheAnswersOfOthersWithAnEvent) {
  common::EventLog log;
  FlightRequests requests(0.275, nullptr, log);
  requests.answered({5, true, "map a.yaml is the given one"}, timeAt(1.0));
  requests.answered({6, false, "no such map"}, timeAt(1.0));
  const auto answers = requests.takeAnswers(timeAt(1.1));
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_FALSE(answers[1].done);
  const auto events = log.take();
  ASSERT_EQ(events.size(), 1u) << "what fails is told by the leaf";
  EXPECT_EQ(events[0].text, "map a.yaml is the given one");
}

TEST(FlightRequests, PhotographsTheFirstFrameThatIsMeasuredAfterIt) {
  common::RgbdCameraConfig camera;
  camera.mount = {.x_m = 0.1, .z_m = 0.05};
  common::EventLog log;
  FlightRequests requests(0.275, &camera, log);
  requests.take({5, common::PhotographRequest{"door"}}, worldAt(3.0));
  common::VehicleState state;
  state.T_odom_body.position_m = {1.0, 2.0, 1.5};
  requests.addFrame(frameAt(2.9), state);
  EXPECT_TRUE(requests.takeFiles().empty()) << "it was measured before";
  requests.addFrame(frameAt(3.1), state);
  const auto files = requests.takeFiles();
  ASSERT_EQ(files.size(), 1u);
  const auto& photo = std::get<Photo>(files[0]);
  EXPECT_EQ(photo.name, "door");
  EXPECT_TRUE(photo.T_map_camera.position_m.isApprox(Eigen::Vector3d(1.1, 2.0, 1.55)));
  const auto answers = requests.takeAnswers(timeAt(3.2));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(answers[0].done);
  requests.addFrame(frameAt(3.2), state);
  EXPECT_TRUE(requests.takeFiles().empty()) << "one picture";
}

TEST(FlightRequests, GivesUpAPhotographWithoutFramesOrCamera) {
  common::RgbdCameraConfig camera;
  common::EventLog log;
  FlightRequests requests(0.275, &camera, log);
  requests.take({5, common::PhotographRequest{"door"}}, worldAt(3.0));
  EXPECT_TRUE(requests.takeAnswers(timeAt(4.9)).empty());
  const auto late = requests.takeAnswers(timeAt(5.1));
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0].reason, "no usable frame of the camera for 2 s");
  FlightRequests blind(0.275, nullptr, log);
  blind.take({6, common::PhotographRequest{"door"}}, worldAt(3.0));
  EXPECT_EQ(blind.takeAnswers(timeAt(3.0)).at(0).reason, "the vehicle has no RGB-D camera");
}

}  // namespace
}  // namespace swiftlet::autonomy
