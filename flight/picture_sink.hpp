// Draws the pictures of a run's report every few seconds of a flight.
#pragma once

#include <memory>

#include "autonomy/loop/flight_sink.hpp"
#include "common/jobs.hpp"
#include "common/trajectory.hpp"
#include "flight/wall_clock.hpp"

namespace swiftlet::interfaces {
class RunFolder;
}

namespace swiftlet::flight {

class MotionReference;

/// Refers to its arguments, which must outlive it, and gives the pictures to the folder. Call it after the sinks that
/// write the folder and the reference (may be null).
class PictureSink final : public autonomy::FlightSink {
 public:
  PictureSink(interfaces::RunFolder& folder, const MotionReference* reference, double hull_diameter_m);

  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  /// Draws the pictures of the end at once.
  void drawNow(const common::World& world);

 private:
  common::Trajectory truth_map() const;

  interfaces::RunFolder& folder_;
  const MotionReference* reference_;
  double hull_diameter_m_;
  common::Time now_;
  Clock::time_point drawn_;
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(1);
};

}  // namespace swiftlet::flight
