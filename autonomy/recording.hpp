// A flight as the list of its inputs, kept in memory, and given again to another autonomy.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "autonomy/flight_sink.hpp"
#include "autonomy/input.hpp"

namespace swiftlet::autonomy {

class Autonomy;

/// In the order in which they were processed. A value: scans and camera frames are immutable and shared with the
/// flight.
using Recording = std::vector<Input>;

class InputRecorder final : public FlightSink {
 public:
  void input(const Input& input) override { recording_.push_back(input); }
  const Recording& recording() const { return recording_; }

 private:
  Recording recording_;
};

/// Gives the inputs to an autonomy that was made as the recorded one was (settings, data sheets, mission, given map)
/// and has processed nothing yet; its jobs are those of makeLockstepJobs. The sinks are told what those of the flight
/// were told, bit for bit, but for what was no answer of the autonomy's (the end of the vehicle, slow jobs). A job is
/// done again and delivered where the recording delivers it. Ends early, with the reason, where the recording delivers
/// a job that this autonomy has not submitted at that time: it is of another flight, or was changed.
tl::expected<void, std::string> replay(const Recording& recording, Autonomy& autonomy,
                                       const std::vector<FlightSink*>& sinks);

}  // namespace swiftlet::autonomy
