// The sink that writes control.tsv and fusion.tsv of a flight.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "autonomy/loop/flight_sink.hpp"
#include "interfaces/control_log.hpp"
#include "perception/fusion/filter_tape.hpp"

namespace swiftlet::flight {

class MotionReference;

class ControlLogSink final : public autonomy::FlightSink, public perception::FilterListener {
 public:
  /// The columns of the truth have the reference, which must outlive every call of ticked(); null: they stay empty.
  ControlLogSink(const std::filesystem::path& run, const MotionReference* reference);

  void input(const autonomy::Input& input) override;
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void heard(const perception::FilterInput& input) override;

  /// Writes what is left.
  void finish();
  /// Why something could not be written; nullopt without a failure. Nothing is written after that.
  const std::optional<std::string>& failure() const { return failure_; }

 private:
  void note(const interfaces::Written& written);

  const MotionReference* reference_;
  std::optional<interfaces::ControlLogWriter> writer_;
  std::optional<interfaces::AppendFile> tape_;
  std::string tape_block_;
  std::optional<std::string> failure_;
  double battery_v_ = 0.0;
  bool flying_ = false;
  bool pilot_flies_ = false;  ///< The commands of the log are not those that are flown.
};

}  // namespace swiftlet::flight
