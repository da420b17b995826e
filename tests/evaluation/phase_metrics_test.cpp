// Figures over parts of a flight, and the criteria on them.
#include "evaluation/phase_metrics.hpp"

#include <numbers>

#include <gmock/gmock.h>

#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Time;
using testing::ElementsAre;
using testing::IsEmpty;

class Phase : public testing::Test {
 protected:
  explicit Phase(PhaseConfig config = {.name = "hold", .phase = "hold", .settle_s = 1.0, .place_map_m = {1.0, 0.0}})
      : recorder_(std::move(config)) {}

  void see(const std::string& phase, const std::vector<double>& level_heights_m = {}) {
    test::Layers layers;
    layers.mission.status.phase = phase;
    auto levels = std::make_shared<common::LevelMap>();
    for (const double height_m : level_heights_m) levels->levels.push_back({0, height_m, 0.0, {}});
    layers.map.levels = levels;
    recorder_.world(layers.world());
  }
  void tick(double x_m, double height_m = 1.0, double speed_m_s = 0.0, double yaw_rad = 0.0) {
    time_ = time_ + common::Duration::fromMilliseconds(500);
    common::Pose3 pose;
    pose.position_m = {x_m, 0.0, height_m};
    pose.rotation = common::quaternionFrom({0.0, 0.0, yaw_rad});
    common::VehicleState estimate;
    estimate.stamp = time_;
    estimate.velocity_odom_m_s = {speed_m_s + 0.1, 0, 0};
    recorder_.tick({time_, pose, {speed_m_s, 0, 0}, estimate});
  }
  double figure(const std::string& name) const { return recorder_.finish().figure(name).value(); }

  PhaseRecorder recorder_;
  Time time_;
};

TEST_F(Phase, CountsOnlyWhileItLastsAndAfterItHasSettled) {
  see("explore");
  tick(9.0);
  EXPECT_THAT(recorder_.finish().figures, ElementsAre(testing::Pair("time_s", 0.0)));
  see("hold");
  tick(7.0);
  tick(5.0);
  tick(1.1, 1.02, 0.2, 0.1);
  tick(0.9, 0.98, 0.0, -0.1);
  see("explore");
  tick(9.0);
  EXPECT_NEAR(figure("time_s"), 0.5, 1e-9);
  EXPECT_NEAR(figure("position_mean_x_m"), 1.0, 1e-9);
  EXPECT_NEAR(figure("position_std_m"), 0.1, 1e-9);
  EXPECT_NEAR(figure("position_rms_m"), 0.1, 1e-9);
  EXPECT_GE(figure("position_max_m"), 0.1 - 1e-9);
  EXPECT_NEAR(figure("speed_mean_m_s"), 0.1, 1e-9);
  EXPECT_NEAR(figure("speed_std_m_s"), 0.1, 1e-9);
  EXPECT_NEAR(figure("speed_axis_mean_m_s"), 0.1, 1e-9) << "along x; along y it rests";
  EXPECT_NEAR(figure("speed_axis_std_m_s"), 0.1, 1e-9);
  EXPECT_NEAR(figure("height_mean_m"), 1.0, 1e-9);
  EXPECT_NEAR(figure("height_std_m"), 0.02, 1e-9);
  EXPECT_NEAR(figure("yaw_std_rad"), 0.1, 1e-9);
  EXPECT_NEAR(figure("velocity_error_mean_m_s"), 0.1, 1e-9);
  EXPECT_NEAR(figure("velocity_error_rms_m_s"), 0.1, 1e-9);
}

TEST_F(Phase, SettlesAgainAtEachBegin) {
  for (int round = 0; round < 2; ++round) {
    see("hold");
    for (int i = 0; i < 4; ++i) tick(1.0);
    see("explore");
    tick(8.0);
  }
  EXPECT_NEAR(figure("time_s"), 1.0, 1e-9) << "twice 0.5 s between two ticks, without the gap";
  EXPECT_NEAR(figure("position_rms_m"), 0.0, 1e-9);
}

/// The controller of a vehicle on the floor holds nothing.
TEST_F(Phase, StandingIsNoHover) {
  see("hold");
  for (int i = 0; i < 4; ++i) tick(1.0);
  for (int i = 0; i < 1000; ++i) {
    time_ = time_ + common::Duration::fromMilliseconds(500);
    recorder_.stand();
  }
  EXPECT_NEAR(figure("time_s"), 0.5, 1e-9);
}

TEST_F(Phase, CountsFromItsFirstTickHowLongTheWayBackTakes) {
  see("hold");
  const double places_m[] = {1.0, 0.0, 0.5, 0.79, 0.81, 1.1, 1.0};
  const double yaws_rad[] = {0.5, 1.3, 1.0, 0.6, 0.53, 0.52, 0.51};
  for (int i = 0; i < 7; ++i) tick(places_m[i], 1.0, 0.0, yaws_rad[i]);
  EXPECT_NEAR(figure("position_return_s"), 1.5, 1e-9) << "0.21 m off at the fourth tick, and then no more";
  EXPECT_NEAR(figure("yaw_return_s"), 1.5, 1e-9);
  EXPECT_NEAR(figure("yaw_off_max_rad"), 0.5, 1e-9) << "of the ticks from 1 s on, against the first one of all";
}

class PhaseAtHeight : public Phase {
 protected:
  PhaseAtHeight() : Phase({.name = "hold", .phase = "hold", .height_map_m = 0.6}) {}
};

TEST_F(PhaseAtHeight, IsJudgedByItsGreatestError) {
  see("hold");
  for (const double height_m : {0.61, 0.6, 0.52, 0.6}) tick(1.0, height_m);
  EXPECT_NEAR(figure("height_error_max_m"), 0.08, 1e-9);
}

TEST_F(Phase, HasTheControllersErrorOnlyWhereThereIsAReference) {
  see("hold");
  for (int i = 0; i < 4; ++i) tick(1.0);
  EXPECT_FALSE(recorder_.finish().figure("control_error_max_m"));
  PhaseTick off{time_, {}, {}, {}, Eigen::Vector3d(0.03, 0.0, 0.04)};
  recorder_.tick(off);
  EXPECT_NEAR(figure("control_error_max_m"), 0.05, 1e-9);
}

TEST_F(Phase, HasTheLevelsOfItsLastMap) {
  see("hold");
  for (int i = 0; i < 4; ++i) tick(1.0);
  see("hold", {0.74, 0.0});
  EXPECT_EQ(figure("levels"), 2);
  EXPECT_NEAR(figure("level_0_height_m"), 0.0, 1e-9);
  EXPECT_NEAR(figure("level_1_height_m"), 0.74, 1e-9);
}

/// The estimate is of the last inertial sample: compared with the truth of the tick it would seem to lag.
TEST(PhaseVelocity, IsComparedWithTheTruthAtTheTimeOfTheEstimate) {
  PhaseRecorder recorder({.name = "all"});
  recorder.world(test::Layers().world());
  for (int tick = 1; tick <= 100; ++tick) {
    const Time now = Time::fromSeconds(0.01 * tick);
    common::VehicleState estimate;
    estimate.stamp = now - common::Duration::fromMilliseconds(6);
    estimate.velocity_odom_m_s.x() = 3.0 * estimate.stamp.seconds() + 0.02;
    recorder.tick({now, {}, {3.0 * now.seconds(), 0, 0}, estimate});
  }
  EXPECT_NEAR(recorder.finish().figure("velocity_error_mean_m_s").value(), 0.02, 1e-9);
  EXPECT_NEAR(recorder.finish().figure("velocity_error_rms_m_s").value(), 0.02, 1e-9);
}

TEST(PhaseYaw, IsAveragedOnTheCircle) {
  PhaseRecorder recorder({.name = "all"});
  recorder.world(test::Layers().world());
  Time time = Time::fromSeconds(1.0);
  for (const double yaw_rad : {3.1, -3.1}) {
    common::Pose3 pose;
    pose.rotation = common::quaternionFrom({0.0, 0.0, yaw_rad});
    recorder.tick({time, pose, {0, 0, 0}, {}});
    time = time + common::Duration::fromMilliseconds(10);
  }
  EXPECT_NEAR(recorder.finish().figure("yaw_std_rad").value(), std::numbers::pi - 3.1, 1e-9);
}

TEST(PhaseCriteria, NameWhatIsMissedAndWhatIsLacking) {
  PhaseScore score{"hold", {{"position_std_m", 0.06}, {"height_mean_m", 1.0}}, {}};
  const auto bound = [](const char* figure, double min, double max) {
    PhaseBound made;
    made.figure = figure;
    made.min = min;
    made.max = max;
    return made;
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  score.criteria = {bound("position_std_m", -kAny, 0.05), bound("height_mean_m", 0.95, 1.05),
                    bound("position_rms_m", -kAny, 0.1)};
  EXPECT_THAT(score.missed(), ElementsAre("phase hold: position_std_m: 0.0600, at most 0.05 was asked for",
                                          "phase hold: position_rms_m: not measured, at most 0.1 was asked for"));
  score.criteria.clear();
  EXPECT_THAT(score.missed(), IsEmpty());
}

}  // namespace
}  // namespace swiftlet::evaluation
