// Records what the RGB-D camera of a flight saw in the folder rgbd of the run, with its true poses if they are known.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "autonomy/loop/flight_sink.hpp"
#include "interfaces/rgbd/rgbd_recorder.hpp"

namespace swiftlet::flight {

class MotionReference;

class RgbdSink final : public autonomy::FlightSink {
 public:
  /// Refers to the reference (may be null), which must outlive every call of ticked().
  RgbdSink(const std::filesystem::path& run, const MotionReference* reference);

  void input(const autonomy::Input& input) override;
  void ticked(const autonomy::TickOutcome& outcome) override;

  /// Why something could not be written; nullopt without a failure. Nothing is written after that.
  const std::optional<std::string>& failure() const { return failure_; }
  /// See RgbdRecorder::add.
  std::size_t leftOut() const { return recorder_ ? recorder_->leftOut() : 0; }

 private:
  void note(const interfaces::Written& written);

  const MotionReference* reference_;
  std::optional<interfaces::RgbdRecorder> recorder_;
  std::optional<std::string> failure_;
};

}  // namespace swiftlet::flight
