// Frames on their way into the 3D map: when they are mapped, what they leave, and what is said.
#include "autonomy/estimation/rgbd_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

class RgbdStory : public testing::Test {
 protected:
  static common::RgbdCameraConfig camera() {
    common::RgbdCameraConfig camera;
    camera.mount = {};
    return camera;
  }
  static std::shared_ptr<const common::KeyPoses> keysAt(std::uint64_t version, const common::Pose2& pose) {
    return std::make_shared<const common::KeyPoses>(common::KeyPoses{version, {{{}, pose}}});
  }
  std::shared_ptr<const common::RgbdFrame> frameAt(double time_s) const {
    return std::make_shared<const common::RgbdFrame>(room_.seen({}, time_s));
  }
  /// The vehicle stands at the origin.
  FrameSituation situation() const {
    FrameSituation situation;
    situation.at_key = common::KeyRelativePose{0, {}};
    situation.body = BodyAtFrame{Eigen::Quaterniond::Identity(), {}};
    situation.supported = true;
    situation.keys = keys_;
    return situation;
  }
  /// A frame arrives and is mapped, and its job is delivered.
  void see(double time_s) {
    pipeline_.add(frameAt(time_s));
    ASSERT_TRUE(pipeline_.next());
    pipeline_.map(situation(), Time::fromSeconds(time_s));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.065));
  }
  std::vector<std::string> texts() {
    std::vector<std::string> texts;
    for (const common::Event& event : log_.take()) texts.push_back(event.text);
    return texts;
  }

  mapping3d::TexturedRoom room_;
  std::shared_ptr<const common::KeyPoses> keys_ = keysAt(1, {});
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  common::EventLog log_;
  RgbdPipeline pipeline_{RgbdPipelineConfig(), camera(), *jobs_, log_};
};

TEST_F(RgbdStory, ANewerFrameReplacesTheOneThatWaits) {
  pipeline_.add(frameAt(1.0));
  pipeline_.map(situation(), Time::fromSeconds(1.0));
  EXPECT_FALSE(pipeline_.next()) << "nothing waits";
  pipeline_.add(frameAt(1.02));
  pipeline_.add(frameAt(1.04));
  EXPECT_FALSE(pipeline_.next()) << "one is being mapped";
  jobs_->deliverDue(Time::fromSeconds(1.07));
  ASSERT_TRUE(pipeline_.next());
  EXPECT_EQ(*pipeline_.next(), Time::fromSeconds(1.04));
  EXPECT_EQ(pipeline_.counts().frames, 3u);
  EXPECT_EQ(pipeline_.counts().mapped, 1u);
}

TEST_F(RgbdStory, OverARadioAFrameIsMappedWhenItHasComeThrough) {
  RgbdPipelineConfig config;
  config.radio.link_kB_s = 2000.0;  // The room has exact depths, which take four bytes a pixel.
  RgbdPipeline pipeline(config, camera(), *jobs_, log_);
  pipeline.add(frameAt(1.0));
  pipeline.watch(keys_, Time::fromSeconds(1.001));
  EXPECT_FALSE(pipeline.next()) << "it is on the way";
  pipeline.watch(keys_, Time::fromSeconds(1.3));
  ASSERT_TRUE(pipeline.next());
  EXPECT_EQ(*pipeline.next(), Time::fromSeconds(1.0)) << "its own time";
  EXPECT_EQ(pipeline.radioCounts()->sent, 1u);
  EXPECT_FALSE(pipeline_.radioCounts());
}

TEST_F(RgbdStory, ARadioThatCarriesNoFrameInTimeIsReportedWithTheRemedy) {
  RgbdPipelineConfig config;
  config.radio.link_kB_s = 5.0;
  RgbdPipeline pipeline(config, camera(), *jobs_, log_);
  std::vector<common::Event> events;
  for (int i = 0; i < 40; ++i) {
    pipeline.add(frameAt(1.0 + 0.1 * i));
    pipeline.watch(keys_, Time::fromSeconds(1.0 + 0.1 * i));
    for (common::Event& event : log_.take()) events.push_back(std::move(event));
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].text, "frames are downscaled for the radio");
  EXPECT_THAT(events[0].reason, testing::HasSubstr("the map has 1 in 4 of their pixels"));
  EXPECT_EQ(events[1].text, "no frame comes through the radio");
  EXPECT_THAT(events[1].reason, testing::HasSubstr("use a faster radio or a camera with fewer pixels"));
}

TEST_F(RgbdStory, HowMuchSmallerFramesAreSentIsTold) {
  RgbdPipelineConfig config;
  config.radio.link_kB_s = 5.0;
  RgbdPipeline pipeline(config, camera(), *jobs_, log_);
  mapping3d::TexturedRoom wide;
  wide.camera = {1280, 960, 1160.0, 1160.0, 639.5, 479.5};
  pipeline.add(std::make_shared<const common::RgbdFrame>(wide.seen({}, 1.0)));
  pipeline.watch(keys_, Time::fromSeconds(1.0));
  const std::vector<common::Event> events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "frames are downscaled for the radio");
  EXPECT_THAT(events[0].reason, testing::HasSubstr("the map has 1 in 64 of their pixels")) << "halved three times";
}

TEST_F(RgbdStory, TheLayerMovesWithTheKeyScans) {
  EXPECT_EQ(pipeline_.layer(keys_), nullptr);
  see(1.0);
  const auto first = pipeline_.layer(keys_);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->tracked);
  EXPECT_EQ(first->submaps->size(), 1u);
  EXPECT_EQ(pipeline_.layer(keys_), first) << "nothing has changed";
  const auto moved = pipeline_.layer(keysAt(2, {0.5, 0.0, 0.0}));
  EXPECT_NE(moved, first);
  EXPECT_EQ(moved->submaps, first->submaps) << "nothing is drawn again";
  EXPECT_NEAR(moved->T_map_camera.position_m.x() - first->T_map_camera.position_m.x(), 0.5, 1e-9);
}

/// The whole map follows a loop closure within five seconds, and knows its age.
TEST_F(RgbdStory, AClosureFusesTheSubmapsAgain) {
  see(1.0);
  const auto tickUntil = [&](double from_s, double to_s) {
    for (double time_s = from_s; time_s < to_s; time_s += 0.01) {
      pipeline_.watch(keys_, Time::fromSeconds(time_s));
      jobs_->deliverDue(Time::fromSeconds(time_s));
    }
  };
  const auto lowest = [&] {
    const auto blocks = pipeline_.layer(keys_)->fused->blocks();
    return std::min_element(blocks.begin(), blocks.end(), [](auto a, auto b) { return a.x < b.x; })->x;
  };
  tickUntil(1.1, 4.0);
  ASSERT_TRUE(pipeline_.layer(keys_)->fused);
  EXPECT_NEAR(pipeline_.layer(keys_)->fused_stamp.seconds(), 1.1, 0.02);
  const int before = lowest();
  tickUntil(4.0, 6.0);
  EXPECT_NEAR(pipeline_.layer(keys_)->fused_stamp.seconds(), 1.1, 0.02) << "nothing has moved";
  keys_ = keysAt(2, {4.0, 0.0, 0.0});
  tickUntil(6.0, 9.0);
  EXPECT_NEAR(pipeline_.layer(keys_)->fused_stamp.seconds(), 6.0, 0.02);
  EXPECT_EQ(lowest(), before + 10) << "4 m are ten blocks of 0.4 m";
}

TEST_F(RgbdStory, TheFilterGetsAMeasurementFromFrameToFrame) {
  see(1.0);
  auto step = pipeline_.steps().take();
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->measurement);
  EXPECT_EQ(step->clone_after, Time::fromSeconds(1.0));
  see(1.1);
  step = pipeline_.steps().take();
  ASSERT_TRUE(step && step->measurement);
  EXPECT_EQ(step->measurement->from, Time::fromSeconds(1.0));
  EXPECT_LT(step->measurement->pose3.position_m.norm(), 0.01);
  EXPECT_FALSE(pipeline_.steps().take()) << "it counts once";
  // The filter has dropped its clone: the next frame begins a new one.
  pipeline_.steps().forgetClone();
  see(1.2);
  step = pipeline_.steps().take();
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->measurement);
  EXPECT_EQ(step->clone_after, Time::fromSeconds(1.2));
}

TEST_F(RgbdStory, ASilentCameraIsReportedOnceAndSoIsItsReturn) {
  see(1.0);
  pipeline_.watch(keys_, Time::fromSeconds(1.9));
  pipeline_.watch(keys_, Time::fromSeconds(2.1));
  pipeline_.watch(keys_, Time::fromSeconds(2.2));
  EXPECT_THAT(texts(), testing::ElementsAre("camera is silent"));
  see(3.0);
  EXPECT_THAT(texts(), testing::ElementsAre("camera sends again"));
}

/// A camera whose clock has jumped back, or one behind a lens cap, sends all the time.
TEST_F(RgbdStory, ACameraThatSendsNothingUsableIsReported) {
  see(20.0);
  double time_s = 20.1;
  const auto watchUntil = [&](double end_s, double behind_s) {
    for (; time_s < end_s; time_s += 0.1) {
      common::RgbdFrame frame = *frameAt(time_s);
      frame.stamps.measured = Time::fromSeconds(time_s - behind_s);
      pipeline_.add(std::make_shared<const common::RgbdFrame>(frame));
      pipeline_.watch(keys_, Time::fromSeconds(time_s));
    }
  };
  watchUntil(20.95, 10.0);
  EXPECT_THAT(texts(), testing::ElementsAre("a frame cannot be used"));
  watchUntil(23.0, 10.0);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "camera sends nothing usable");
  EXPECT_EQ(events[0].reason, "no usable frame for 1.0 s; the last one: it was not measured after the last");
  EXPECT_LT(events[0].stamp.seconds(), 21.15);
  watchUntil(23.2, 0.0);
  EXPECT_THAT(texts(), testing::ElementsAre("camera sends again"));
}

TEST_F(RgbdStory, APictureThatIsRepeatedWithNewStampsIsRefused) {
  see(1.0);
  for (const double time_s : {1.1, 1.2}) {
    common::RgbdFrame repeated = *frameAt(1.0);
    repeated.stamps = frameAt(time_s)->stamps;
    EXPECT_FALSE(pipeline_.add(std::make_shared<const common::RgbdFrame>(repeated)));
    EXPECT_FALSE(pipeline_.next());
  }
  EXPECT_EQ(pipeline_.counts().skipped, 2u);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_THAT(events[0].reason, testing::HasSubstr("repeats the last picture"));
  see(1.3);
  EXPECT_EQ(pipeline_.counts().mapped, 2u);
}

/// The holes of some drivers are NaN, which equals nothing.
TEST_F(RgbdStory, HolesDoNotHideARepeatedPictureAndAreNone) {
  const auto add = [this](double time_s, auto change) {
    common::RgbdFrame frame = *frameAt(1.0);
    frame.stamps = frameAt(time_s)->stamps;
    change(frame.depth.depth_m);
    return pipeline_.add(std::make_shared<const common::RgbdFrame>(frame));
  };
  const auto pierce = [](std::vector<float>& depth_m) { depth_m[7] = NAN; };
  EXPECT_TRUE(add(1.0, pierce));
  EXPECT_FALSE(add(1.1, pierce));
  const auto hide = [](std::vector<float>& depth_m) { depth_m.assign(depth_m.size(), common::DepthImage::kUnknown); };
  EXPECT_TRUE(add(1.2, hide));
  EXPECT_TRUE(add(1.3, hide)) << "where nothing is measured there is no noise";
}

/// What is seen within 0.4 s of the last copy of the submaps reaches the others with the next frame, if one comes.
TEST_F(RgbdStory, WhatWasSeenLastIsPublishedWhenTheCameraStops) {
  see(1.0);
  const auto first = pipeline_.layer(keys_)->submaps;
  see(1.2);
  EXPECT_EQ(pipeline_.layer(keys_)->submaps, first);
  const auto watch = [this](double time_s) {
    pipeline_.watch(keys_, Time::fromSeconds(time_s));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.1));
  };
  watch(1.7);
  EXPECT_EQ(pipeline_.layer(keys_)->submaps, first) << "a frame may come";
  watch(1.9);
  const auto last = pipeline_.layer(keys_)->submaps;
  EXPECT_NE(last, first);
  watch(4.0);
  EXPECT_EQ(pipeline_.layer(keys_)->submaps, last) << "nothing was drawn since";
}

TEST_F(RgbdStory, ATrackThatIsLostAndFoundIsReported) {
  for (int i = 0; i < 3; ++i) see(1.0 + 0.1 * i);
  room_.walls = 100;
  room_.half_size_m = {1.3, 3.0, 1.1};
  for (int i = 0; i < 5; ++i) see(2.0 + 0.2 * i);
  EXPECT_THAT(texts(), testing::ElementsAre("3D track lost"));
  EXPECT_EQ(pipeline_.counts().lost, 5u);
  // The seeds tell the place, so the map begins anew there.
  see(3.0);
  EXPECT_THAT(texts(), testing::ElementsAre("3D track found again"));
}

TEST_F(RgbdStory, FramesThatCannotBeUsedAreCountedAndSaidOnce) {
  see(1.0);
  pipeline_.add(frameAt(1.0));
  common::RgbdFrame torn = *frameAt(1.1);
  torn.depth.depth_m.pop_back();
  pipeline_.add(std::make_shared<const common::RgbdFrame>(torn));
  EXPECT_FALSE(pipeline_.next());
  EXPECT_EQ(pipeline_.counts().skipped, 2u);
  EXPECT_THAT(texts(), testing::ElementsAre("a frame cannot be used", "a frame cannot be used")) << "one a reason";
  pipeline_.add(frameAt(1.0));
  EXPECT_TRUE(texts().empty());
}

TEST_F(RgbdStory, AStampOfTheFutureDoesNotEndTheMap) {
  see(1.0);
  common::RgbdFrame future = *frameAt(90.0);
  future.stamps.arrived = Time::fromSeconds(1.1);
  EXPECT_FALSE(pipeline_.add(std::make_shared<const common::RgbdFrame>(future)));
  EXPECT_EQ(pipeline_.counts().skipped, 1u);
  see(1.2);
  EXPECT_EQ(pipeline_.counts().mapped, 2u);
}

TEST_F(RgbdStory, BlackAndWhitePicturesAreLeftOutAndCounted) {
  see(1.0);
  double time_s = 1.1;
  for (const int value : {2, 255}) {
    common::RgbdFrame blank = *frameAt(time_s);
    blank.color.rgb.assign(blank.color.rgb.size(), static_cast<std::uint8_t>(value));
    EXPECT_FALSE(pipeline_.add(std::make_shared<const common::RgbdFrame>(blank)));
    EXPECT_FALSE(pipeline_.next());
    time_s += 0.1;
  }
  EXPECT_EQ(pipeline_.counts().blank, 2u);
  EXPECT_EQ(pipeline_.counts().skipped, 2u);
  EXPECT_EQ(texts().size(), 2u);
  see(time_s);
  EXPECT_EQ(pipeline_.counts().mapped, 2u);
}

TEST_F(RgbdStory, NothingIsMappedBeforeThe2DMap) {
  keys_ = std::make_shared<const common::KeyPoses>();
  pipeline_.add(frameAt(1.0));
  pipeline_.map(situation(), Time::fromSeconds(1.0));
  EXPECT_TRUE(jobs_->idle("mapping3d"));
  EXPECT_EQ(pipeline_.layer(keys_), nullptr);
}

TEST_F(RgbdStory, TheMountIsFoundInFlight) {
  room_.camera = {160, 120, 145.0, 145.0, 79.5, 59.5};
  const common::Pose3 mount{common::expSO3({0.012, -0.014, 0.01}),
                            Eigen::Vector3d::Zero()};  // The data sheet says the identity.
  for (double time_s = 1.0; time_s < 13.0; time_s += 0.1) {
    const common::Pose3 body{common::expSO3({0.0, 0.0, 0.9 * std::sin(0.8 * time_s)}),
                             {1.4 * std::sin(0.5 * time_s), 0.9 * std::sin(0.7 * time_s), 0.0}};
    FrameSituation there = situation();
    there.at_key->T_key_body = body;
    there.body->R_odom_body = body.rotation;
    there.body->motion.time = Time::fromSeconds(time_s);
    pipeline_.add(std::make_shared<const common::RgbdFrame>(room_.seen(body * mount, time_s)));
    pipeline_.map(there, Time::fromSeconds(time_s));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.065));
  }
  const common::CameraEstimate& camera = pipeline_.layer(keys_)->camera;
  EXPECT_LT(camera.T_body_camera.rotation.angularDistance(mount.rotation), 0.2 * common::logSO3(mount.rotation).norm());
  EXPECT_LT(camera.mount_sigma_rad.maxCoeff(), 0.0075);
  EXPECT_EQ(camera.clock_offset_s, 0.0) << "no rates, no clock";
  EXPECT_THAT(texts(), testing::ElementsAre("mount of the camera estimated"));
}

TEST_F(RgbdStory, TheFirstFrameWaitsForAMeasuredPose) {
  FrameSituation unknown = situation();
  unknown.at_key.reset();
  FrameSituation predicted = situation();
  predicted.supported = false;
  for (const FrameSituation& early : {unknown, predicted}) {
    pipeline_.add(frameAt(1.0 + 0.1 * static_cast<double>(pipeline_.counts().frames)));
    pipeline_.map(early, Time::fromSeconds(1.2));
    EXPECT_TRUE(jobs_->idle("mapping3d"));
  }
  pipeline_.add(frameAt(2.0));
  FrameSituation there = situation();
  there.at_key->T_key_body.position_m = {1.0, 2.0, 0.5};
  pipeline_.map(there, Time::fromSeconds(2.0));
  jobs_->deliverDue(Time::fromSeconds(2.1));
  ASSERT_TRUE(pipeline_.layer(keys_));
  EXPECT_TRUE(pipeline_.layer(keys_)->T_map_camera.position_m.isApprox(there.at_key->T_key_body.position_m));
  // Later frames are aligned to the map, so they need none.
  pipeline_.add(frameAt(2.2));
  pipeline_.map(unknown, Time::fromSeconds(2.2));
  EXPECT_FALSE(jobs_->idle("mapping3d"));
}

}  // namespace
}  // namespace swiftlet::autonomy
