#include "flight/rgbd_sink.hpp"

#include <utility>

#include "flight/motion_reference.hpp"

namespace swiftlet::flight {

RgbdSink::RgbdSink(const std::filesystem::path& run, const MotionReference* reference) : reference_(reference) {
  auto made = interfaces::RgbdRecorder::create(run / "rgbd");
  if (made)
    recorder_ = std::move(*made);
  else
    failure_ = made.error().message.text();
}

void RgbdSink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr || !recorder_) return;
  if (const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(event)) note(recorder_->add(**frame));
}

void RgbdSink::ticked(const autonomy::TickOutcome& outcome) {
  if (recorder_ && reference_ != nullptr) note(recorder_->addTruth(outcome.now, reference_->T_map_camera()));
}

void RgbdSink::note(const interfaces::Written& written) {
  if (written) return;
  failure_ = written.error().message.text();
  recorder_.reset();
}

}  // namespace swiftlet::flight
