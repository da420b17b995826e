// A flight as the list of its inputs, kept in memory, and replayed with another autonomy.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "autonomy/input.hpp"
#include "autonomy/loop/flight_sink.hpp"

namespace swiftlet::autonomy {

class Autonomy;

/// Inputs in the order of processing. A value: scans and camera frames are immutable and shared with the flight.
using Recording = std::vector<Input>;

class InputRecorder final : public FlightSink {
 public:
  void input(const Input& input) override { recording_.push_back(input); }
  const Recording& recording() const { return recording_; }

 private:
  Recording recording_;
};

/// Gives the inputs to an autonomy that was made like the recorded one (settings, data sheets, mission, given map) and
/// has processed nothing yet; its jobs are those of makeLockstepJobs. The sinks receive the same as in the flight, bit
/// for bit, except events that did not come from the autonomy (the end of the vehicle, slow jobs). A job is computed
/// again and delivered at the place of its delivery in the recording. Ends early, with the reason, if the recording
/// delivers a job that this autonomy has not submitted by then: the recording is of another flight, or was changed.
tl::expected<void, std::string> replay(const Recording& recording, Autonomy& autonomy,
                                       const std::vector<FlightSink*>& sinks);

}  // namespace swiftlet::autonomy
