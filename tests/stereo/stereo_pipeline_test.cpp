// Pairs on their way into the filter: what they measure, and what is said.
#include "autonomy/estimation/stereo_pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pair_rig.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose3;
using common::Time;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class StereoStory : public testing::Test {
 protected:
  /// A pair arrives and is matched, and its job is delivered.
  std::optional<CameraStep> see(const Pose3& pose, double time_s) { return give(rig_.taken(pose, time_s), time_s); }
  std::optional<CameraStep> give(common::RgbdFrame pair, double time_s) {
    pair.stamps.arrived = Time::fromSeconds(time_s + 0.3);
    pipeline_.add(std::make_shared<const common::RgbdFrame>(std::move(pair)), Time::fromSeconds(time_s + 0.3));
    pipeline_.watch(Time::fromSeconds(time_s + 0.3));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.4));
    return pipeline_.take();
  }
  std::vector<std::string> texts() {
    std::vector<std::string> texts;
    for (const common::Event& event : log_.take()) texts.push_back(event.text);
    return texts;
  }

  common::RgbdCameraConfig sheet_ = shippedPair();
  PairRig rig_{sheet_, furnishedRoom(simulation::Pattern::kCarpet)};
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  common::EventLog log_;
  StereoPipeline pipeline_{sheet_, *jobs_, log_};
};

TEST_F(StereoStory, TheFirstPairIsClonedAndLaterOnesMeasureTheMotionOfTheBodySince) {
  const auto first = see(hovering(1.2), 1.0);
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->measurement);
  EXPECT_EQ(first->clone_after, Time::fromSeconds(1.0));
  EXPECT_FALSE(pipeline_.take()) << "each step once";

  const Pose3 from = hovering(1.2), to = hovering(1.25, 0.08, 0.05, 0.1);
  const auto second = see(to, 1.25);
  ASSERT_TRUE(second && second->measurement);
  EXPECT_EQ(second->measurement->from, Time::fromSeconds(1.0));
  EXPECT_EQ(second->measurement->stamp, Time::fromSeconds(1.25));
  EXPECT_TRUE(perception::isValid(*second->measurement));
  const Pose3 error = second->measurement->pose3.inverse() * (from.inverse() * to);
  EXPECT_LT(error.position_m.norm(), 0.015);
  EXPECT_LT(common::logSO3(error.rotation).norm(), 0.01);
}

TEST_F(StereoStory, AfterTheClonesAreLostThePairIsANewBeginning) {
  see(hovering(1.2), 1.0);
  pipeline_.forgetClones();
  const auto step = see(hovering(1.2), 1.25);
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->measurement);
  EXPECT_TRUE(step->clone_after);
}

TEST_F(StereoStory, APairThatCannotBeUsedMeasuresNothingAndIsReportedOnce) {
  see(hovering(1.2), 1.0);
  texts();
  for (int i = 1; i <= 3; ++i) {
    common::RgbdFrame pair = rig_.taken(hovering(1.2), 1.0 + 0.25 * i);
    pair.right = nullptr;
    const auto step = give(std::move(pair), 1.0 + 0.25 * i);
    ASSERT_TRUE(step);
    EXPECT_FALSE(step->measurement);
    EXPECT_FALSE(step->clone_after);
  }
  const auto said = texts();
  EXPECT_EQ(std::count(said.begin(), said.end(), "a pair cannot be used"), 1);
}

TEST_F(StereoStory, ThatItIsBlindIsSaidOnceAndTakenBack) {
  see(hovering(1.2), 1.0);
  for (int i = 1; i <= 6; ++i) see(hovering(0.25), 1.0 + 0.25 * i);
  EXPECT_THAT(texts(), Contains("visual odometry unavailable"));
  for (int i = 7; i <= 12; ++i) see(hovering(1.2), 1.0 + 0.25 * i);
  EXPECT_THAT(texts(), Contains("visual odometry available"));
  see(hovering(1.2), 5.0);
  EXPECT_THAT(texts(), IsEmpty());
}

TEST_F(StereoStory, ExchangedPicturesMeasureNothingAndAreReported) {
  see(hovering(1.2), 1.0);
  for (int i = 1; i <= 6; ++i) {
    common::RgbdFrame pair = rig_.taken(hovering(1.2), 1.0 + 0.25 * i);
    auto right = std::make_shared<common::Image>(*pair.right);
    std::swap(pair.color, *right);
    pair.right = std::move(right);
    const auto step = give(std::move(pair), 1.0 + 0.25 * i);
    ASSERT_TRUE(step);
    EXPECT_FALSE(step->measurement);
    EXPECT_FALSE(step->clone_after);
  }
  const auto said = texts();
  EXPECT_EQ(std::count(said.begin(), said.end(), "a pair cannot be used"), 1);
  EXPECT_THAT(said, Contains("visual odometry unavailable"));
}

/// Hovers for eight seconds over a level floor that beams down measure, with a pair that is made by one sheet and read
/// by another.
struct ScaleStory {
  explicit ScaleStory(const common::RgbdCameraConfig& true_sheet, double beams_error_m = 0.0) {
    const common::RgbdCameraConfig sheet = shippedPair();
    simulation::WorldModel floor = simulation::boxRoom();
    for (simulation::Shape& shape : floor.shapes) shape.pattern = simulation::Pattern::kCarpet;
    PairRig rig(true_sheet, floor);
    const auto jobs = common::makeLockstepJobs(0);
    common::EventLog log;
    StereoPipeline pipeline(sheet, *jobs, log);
    for (double time_s = 1.0; time_s < 9.0; time_s += 0.25) {
      const Pose3 pose{common::quaternionFrom({0.03, -0.04, 0.2}), {0.02 * std::sin(time_s), 0.0, 1.1}};
      pipeline.addBeams(Time::fromSeconds(time_s + 0.02), 1.1 + beams_error_m, pose.rotation);
      common::RgbdFrame pair = rig.taken(pose, time_s);
      pair.camera = sheet.camera();
      pair.stamps.arrived = Time::fromSeconds(time_s + 0.1);
      pipeline.add(std::make_shared<const common::RgbdFrame>(std::move(pair)), Time::fromSeconds(time_s + 0.1));
      pipeline.watch(Time::fromSeconds(time_s + 0.1));
      jobs->deliverDue(Time::fromSeconds(time_s + 0.2));
      const auto step = pipeline.take();
      if (step && step->measurement) last_measured_s = time_s;
    }
    for (const common::Event& event : log.take())
      if (event.text == "pairs are not used") reason = event.reason;
  }
  double last_measured_s = 0.0;
  std::string reason;  ///< Why pairs are not used; empty if they are.
};

TEST(StereoScale, ARightSheetAgreesWithTheBeamsAlsoWhereTheseAreOffByACentimetre) {
  for (const double beams_error_m : {-0.01, 0.0, 0.01}) {
    const ScaleStory story(shippedPair(), beams_error_m);
    EXPECT_EQ(story.reason, "") << beams_error_m;
    EXPECT_GT(story.last_measured_s, 8.0);
  }
}

TEST(StereoScale, AWrongBaseIsReportedAndItsMotionsAreNotUsed) {
  common::RgbdCameraConfig shorter = shippedPair();
  shorter.baseline_m = 0.105;
  const ScaleStory story(shorter);
  EXPECT_THAT(story.reason, HasSubstr("these are 114 % of what they should be"));
  EXPECT_LT(story.last_measured_s, 4.5);
}

TEST(StereoScale, AWrongFocalLengthIsReportedAndItsMotionsAreNotUsed) {
  common::RgbdCameraConfig longer = shippedPair();
  longer.field_of_view_deg = 75.0;
  const ScaleStory story(longer);
  EXPECT_NE(story.reason, "");
  EXPECT_LT(story.last_measured_s, 4.5);
}

TEST_F(StereoStory, ARepeatedOrLatePairIsLeftOut) {
  see(hovering(1.2), 1.0);
  EXPECT_FALSE(see(hovering(1.2), 1.0));
  EXPECT_FALSE(see(hovering(1.2), 0.5));
  EXPECT_TRUE(see(hovering(1.2), 1.25));
}

TEST_F(StereoStory, ASilentCameraIsReported) {
  see(hovering(1.2), 1.0);
  for (double now_s = 1.4; now_s < 4.0; now_s += 0.1) pipeline_.watch(Time::fromSeconds(now_s));
  EXPECT_FALSE(texts().empty());
}

TEST(BodyMeasurement, TheErrorOfTheCameraIsCarriedToTheBody) {
  perception::VisualMotion motion;
  motion.from = Time::fromSeconds(1.0);
  motion.to = Time::fromSeconds(1.1);
  motion.T_from_to = {common::expSO3({0.1, 0.2, -0.1}), {0.3, -0.1, 0.2}};
  motion.covariance.setIdentity();
  const Pose3 mount{common::expSO3({0.0, 1.2, 0.1}), {0.3, 0.1, -0.2}};
  const auto exact = bodyMeasurement(motion, mount);
  // Numerically: a small error of the camera's motion moves that of the body as the covariance says.
  Eigen::Matrix<double, 6, 6> jacobian;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
    error[i] = kStep;
    perception::VisualMotion moved = motion;
    moved.T_from_to = motion.T_from_to * Pose3{common::expSO3(error.tail<3>()), error.head<3>()};
    const Pose3 change = exact.pose3.inverse() * bodyMeasurement(moved, mount).pose3;
    jacobian.col(i) << change.position_m / kStep, common::logSO3(change.rotation) / kStep;
  }
  EXPECT_LT((jacobian * jacobian.transpose() - exact.covariance6).norm(), 1e-4);
}

}  // namespace
}  // namespace swiftlet::autonomy
