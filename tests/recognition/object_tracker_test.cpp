#include "perception/recognition/object_tracker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace swiftlet::perception {
namespace {

using common::Pose3;
using common::RecognizedObject;

Recognized seen(const std::string& what, const Eigen::Vector3d& at_camera_m, Passage passage = Passage::kNone,
                double confidence = 0.9) {
  Recognized one;
  one.what = what;
  // x of an opening points to the camera.
  one.T_sensor_object = {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
                         at_camera_m};
  one.covariance.setIdentity();
  one.covariance *= 0.0004;
  one.confidence = confidence;
  one.size_m = {0.9, 1.0};
  one.passage = passage;
  return one;
}
Recognized window(double x_m, double y_m, Passage passage, double confidence = 0.9) {
  return seen("window", {x_m, y_m, 0.0}, passage, confidence);
}

Pose3 aside(double y_m) { return {Eigen::Quaterniond::Identity(), {0.0, y_m, 0.0}}; }

/// A tracker with one key scan, whose place a test may move.
class Looks {
 public:
  void add(const std::vector<Recognized>& recognized, const Pose3& T_key_camera, double time_s = 0.0) {
    tracker_.add(recognized, {0, T_key_camera, 0.0, 0.0, common::Time::fromSeconds(time_s), keys});
  }
  std::vector<RecognizedObject> objects() const { return tracker_.objects(keys); }

  common::KeyPoses keys{1, {{}}};

 private:
  ObjectTracker tracker_;
};

TEST(ObjectTracker, ConfirmsAnOpeningAfterLooksFromThreePlaces) {
  Looks looks;
  for (const double y : {0.0, 0.05, 0.1}) looks.add({window(2.0, -y, Passage::kOpen)}, aside(y));
  ASSERT_EQ(looks.objects().size(), 1U);
  EXPECT_EQ(looks.objects()[0].looks, 1) << "one place";
  EXPECT_EQ(looks.objects()[0].passage, Passage::kNone);
  EXPECT_FALSE(looks.objects()[0].confirmed);
  for (const double y : {0.3, 0.6}) looks.add({window(2.02, -y, Passage::kOpen)}, aside(y), 7.0);
  ASSERT_EQ(looks.objects().size(), 1U);
  const RecognizedObject opening = looks.objects()[0];
  EXPECT_TRUE(opening.confirmed);
  EXPECT_EQ(opening.passage, Passage::kOpen);
  EXPECT_EQ(opening.what, "window");
  EXPECT_EQ(opening.looks, 3);
  EXPECT_EQ(opening.last_seen, common::Time::fromSeconds(7.0));
  EXPECT_NEAR(opening.T_map_object.position_m.x(), 2.013, 0.003);
  EXPECT_LT((opening.T_map_object.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT(opening.yaw_sigma_rad, 0.03);
}

TEST(ObjectTracker, IsNeverSurerThanTheErrorsThatAllLooksShare) {
  Looks looks;
  for (int i = 0; i < 40; ++i) looks.add({window(4.0, -0.3 * i, Passage::kOpen)}, aside(0.3 * i));
  ASSERT_EQ(looks.objects().size(), 1U);
  // A mount that is turned by 0.6 deg about the camera's y moves all of 4 m up or down alike.
  EXPECT_GT(std::sqrt(looks.objects()[0].covariance_m2(2, 2)), 0.9 * 4.0 * 0.6 * common::kRadPerDeg);
}

TEST(ObjectTracker, DoesNotConfirmWhatNoLookToldFromAMirror) {
  Looks looks;
  for (const double y : {0.0, 0.3, 0.6, 0.9}) looks.add({window(2.0, -y, Passage::kOpen, 0.45)}, aside(y));
  EXPECT_EQ(looks.objects().at(0).passage, Passage::kNone);
  EXPECT_FALSE(looks.objects().at(0).confirmed);
}

TEST(ObjectTracker, OneLookAtItsReflectionMakesAMirror) {
  Looks looks;
  for (const double y : {0.0, 0.3, 0.6}) looks.add({window(2.0, -y, Passage::kOpen, 0.45)}, aside(y));
  looks.add({seen("mirror", {2.0, -0.9, 0.0}, Passage::kClosed)}, aside(0.9));
  const RecognizedObject mirror = looks.objects().at(0);
  EXPECT_EQ(mirror.what, "mirror");
  EXPECT_EQ(mirror.passage, Passage::kNone);
  EXPECT_TRUE(mirror.confirmed);
}

TEST(ObjectTracker, AShutterThatIsSeenClosedMoreOftenIsClosed) {
  Looks looks;
  looks.add({window(2.0, 0.0, Passage::kOpen)}, aside(0.0));
  for (const double y : {0.3, 0.6}) looks.add({window(2.0, -y, Passage::kClosed)}, aside(y));
  EXPECT_EQ(looks.objects().at(0).passage, Passage::kClosed);
}

TEST(ObjectTracker, TwoWindowsBesideEachOtherAndTwoPatternsOfOneNameStayApart) {
  Looks looks;
  for (const double y : {0.0, 0.3, 0.6})
    looks.add(
        {window(3.0, 0.7 - y, Passage::kOpen), window(3.0, -0.7 - y, Passage::kOpen), seen("pad", {2.0, 1.0 - y, -0.5}),
         seen("pad", {2.0, -1.0 - y, -0.5}), seen("other", {2.0, 1.0 - y, -0.5})},
        aside(y));
  const auto objects = looks.objects();
  ASSERT_EQ(objects.size(), 5U);
  for (const RecognizedObject& object : objects) EXPECT_TRUE(object.confirmed) << object.what;
  EXPECT_EQ(objects[2].what, "pad");
  EXPECT_EQ(objects[4].what, "other");
}

TEST(ObjectTracker, APatternIsConfirmedBySecondPlace) {
  Looks looks;
  looks.add({seen("pad", {2.0, 0.0, -0.5})}, aside(0.0));
  EXPECT_FALSE(looks.objects().at(0).confirmed);
  looks.add({seen("pad", {2.0, -0.3, -0.5})}, aside(0.3));
  EXPECT_TRUE(looks.objects().at(0).confirmed);
  EXPECT_EQ(looks.objects().at(0).passage, Passage::kNone);
}

// The outer face of a wall of 0.2 m is no second window, and pulls the place of the inner one no farther.
TEST(ObjectTracker, AWindowSeenFromBehindIsTheSameOne) {
  Looks looks;
  for (const double y : {0.0, 0.3, 0.6}) looks.add({window(2.0, -y, Passage::kOpen)}, aside(y));
  const Pose3 outside{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
                      {4.2, 0.0, 0.0}};
  looks.add({window(2.0, 0.0, Passage::kOpen)}, outside);
  ASSERT_EQ(looks.objects().size(), 1U);
  EXPECT_EQ(looks.objects()[0].looks, 4);
  EXPECT_NEAR(looks.objects()[0].T_map_object.position_m.x(), 2.0, 1e-9);
}

TEST(ObjectTracker, ACorrectionOfTheMapMovesItAndMergesWhatWasSeenTwice) {
  common::KeyPoses keys{1, {{}, {{}, {0.0, 1.0, 0.0}, {}}}};
  ObjectTracker tracker;
  for (const double y : {0.0, 0.3, 0.6}) {
    tracker.add({window(2.0, -y, Passage::kOpen)}, {0, aside(y), 0.0, 0.0, {}, keys});
    tracker.add({window(2.0, -y, Passage::kOpen)}, {1, aside(y), 0.0, 0.0, {}, keys});
  }
  ASSERT_EQ(tracker.objects(keys).size(), 2U);
  EXPECT_NEAR(tracker.objects(keys)[1].T_map_object.position_m.y(), 1.0, 1e-6);
  keys.keys[1].T_map_key = {0.0, 0.05, 0.0};
  EXPECT_NEAR(tracker.objects(keys)[1].T_map_object.position_m.y(), 0.05, 1e-6);
  tracker.add({}, {0, aside(0.0), 0.0, 0.0, {}, keys});
  ASSERT_EQ(tracker.objects(keys).size(), 1U);
  EXPECT_EQ(tracker.objects(keys)[0].id, 1);
}

TEST(ObjectTracker, LeavesOutWhatIsNotFinite) {
  Looks looks;
  Recognized broken = window(2.0, 0.0, Passage::kOpen);
  broken.T_sensor_object.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  looks.add({broken}, aside(0.0));
  looks.add({window(2.0, 0.0, Passage::kOpen)}, aside(std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(looks.objects().empty());
}

}  // namespace
}  // namespace swiftlet::perception
