// Draws the pictures of a run's report every few seconds of a flight.
#pragma once

#include <memory>

#include "apps/wall_clock.hpp"
#include "autonomy/loop/flight_sink.hpp"
#include "common/jobs.hpp"

namespace swiftlet::evaluation {
class FlightRecorder;
}
namespace swiftlet::interfaces {
class RunFolder;
}

namespace swiftlet::apps {

/// Refers to its arguments, which must outlive it, and gives the pictures to the folder. Call it after the sinks that
/// write the folder and the recorder.
class PictureSink final : public autonomy::FlightSink {
 public:
  PictureSink(interfaces::RunFolder& folder, const evaluation::FlightRecorder& recorder, double hull_diameter_m);

  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  /// Draws the pictures of the end at once.
  void drawNow(const common::World& world);

 private:
  interfaces::RunFolder& folder_;
  const evaluation::FlightRecorder& recorder_;
  double hull_diameter_m_;
  common::Time now_;
  Clock::time_point drawn_;
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(1);
};

}  // namespace swiftlet::apps
