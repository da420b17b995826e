// Writes the 3D map of a flight into its run folder: every few seconds, and at the end.
#pragma once

#include <memory>

#include "autonomy/loop/flight_sink.hpp"
#include "common/jobs.hpp"
#include "flight/wall_clock.hpp"

namespace swiftlet::interfaces {
class RunFolder;
}

namespace swiftlet::flight {

/// Refers to the folder, which must outlive it. Without an RGB-D camera it does nothing.
class Map3dSink final : public autonomy::FlightSink {
 public:
  explicit Map3dSink(interfaces::RunFolder& folder) : folder_(folder) {}

  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  /// Writes the map of the end at once.
  void writeNow(const common::World& world);

 private:
  interfaces::RunFolder& folder_;
  common::Time now_;
  Clock::time_point next_;      ///< Not earlier are the next files written.
  bool cloud_is_next_ = false;  ///< Else the octrees.
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(1);
};

}  // namespace swiftlet::flight
