// The map and the track that the RGB-D camera alone makes of a flight, beside the vehicle's own estimate.
#include "simulated_flight/visual_odometry_sink.hpp"

#include <gtest/gtest.h>

#include "autonomy/loop/flight_loop.hpp"
#include "common/mailbox.hpp"
#include "evaluation/figure_measures.hpp"
#include "evaluation/flight_score.hpp"
#include "tests/flight_loop/short_flight.hpp"

namespace swiftlet::simulated_flight {
namespace {

using common::Time;

/// Hides every frame of a time span, as a link does that is lost.
class Blinded final : public autonomy::FlightSink {
 public:
  Blinded(autonomy::FlightSink& sink, Time from, Time to) : sink_(sink), from_(from), to_(to) {}
  void input(const autonomy::Input& input) override {
    if (const Time now = autonomy::timeOf(input); now < from_ || now > to_) sink_.input(input);
  }

 private:
  autonomy::FlightSink& sink_;
  Time from_, to_;
};

TEST(VisualOdometrySink, TracksAFlightByItsCameraAloneAndCountsWhatItLoses) {
  common::RgbdCameraConfig camera;
  camera.width_px = 160;
  camera.height_px = 120;
  const autonomy::AutonomyConfig config;
  VisualOdometrySink sink(config.estimator.rgbd.mapper, camera.mount.pose());
  VisualOdometrySink misplaced(config.estimator.rgbd.mapper, common::Pose3{});
  VisualOdometrySink blind(config.estimator.rgbd.mapper, camera.mount.pose());
  Blinded blinded(blind, Time::fromSeconds(4.0), Time::fromSeconds(8.0));
  autonomy::Witness witness;
  const auto vehicle = autonomy::makeVehicle(12, &camera);
  autonomy::Autonomy autonomy = autonomy::makeAutonomy(common::makeLockstepJobs(1), config, nullptr, &camera);
  common::LosslessQueue<common::OperatorCommand> commands;
  autonomy::FlightLoop loop(*vehicle, autonomy, commands, {&witness, &sink, &misplaced, &blinded});
  while (loop.now() < Time::fromSeconds(8))
    if (!loop.step(loop.now() + common::kControlPeriod)) break;

  // The estimate by laser, attitude and height is within centimetres of the truth in such a room.
  common::Trajectory estimate;
  for (const autonomy::TickOutcome& tick : witness.ticks)
    estimate.push_back({tick.state.stamp, tick.state.T_map_body()});
  const evaluation::VisualOdometryRecord record = sink.record();
  evaluation::FlightScore score;
  evaluation::measureVisualOdometry(record, estimate, score);
  EXPECT_GT(record.frames, 80u);
  EXPECT_EQ(record.body.size() + record.lost, record.frames);
  // With seeds 10 to 17 it is 0.04 to 0.27 m, and the rounding of another processor gives others of them. A map that
  // was lost or a step in the wrong direction is a metre off.
  EXPECT_LT(score["visual_odometry_rms_m"].value(), 0.5);
  EXPECT_LT(score["visual_odometry_lost_share"].value(), 0.3)
      << "on the ground the floor is nearer than the camera measures";

  // The body and not the camera: from the same frames, the tracks differ by the mount, which is 10 cm and more off.
  const common::Trajectory camera_track = misplaced.record().body;
  ASSERT_EQ(camera_track.size(), record.body.size());
  const common::Pose3 first = camera_track.front().pose.inverse() * record.body.front().pose;
  const common::Pose3 last = camera_track.back().pose.inverse() * record.body.back().pose;
  EXPECT_LT((first.position_m - last.position_m).norm(), 1e-6) << "the mount is rigid";
  EXPECT_LT((first.position_m - camera.mount.pose().inverse().position_m).norm(), 1e-6);
  EXPECT_LT(blind.record().frames, record.frames);
}

TEST(VisualOdometryOfTornFrames, CountsThemAsLost) {
  VisualOdometrySink sink({}, common::Pose3{});
  auto torn = std::make_shared<common::RgbdFrame>();
  torn->camera = {160, 120, 145.0, 145.0, 79.5, 59.5};
  sink.input(common::SensorEvent(std::shared_ptr<const common::RgbdFrame>(torn)));
  EXPECT_EQ(sink.record().frames, 1u);
  EXPECT_EQ(sink.record().lost, 1u);
}

}  // namespace
}  // namespace swiftlet::simulated_flight
