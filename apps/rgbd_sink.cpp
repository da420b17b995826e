#include "apps/rgbd_sink.hpp"

#include <utility>

#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::apps {

RgbdSink::RgbdSink(const std::filesystem::path& run, const simulation::SimulatedVehicle& vehicle,
                   const common::Pose3& T_body_camera)
    : vehicle_(vehicle), T_body_camera_(T_body_camera) {
  auto made = interfaces::RgbdRecorder::create(run / "rgbd");
  if (made)
    recorder_ = std::move(*made);
  else
    failure_ = made.error().message;
}

void RgbdSink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr || !recorder_) return;
  if (const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(event)) note(recorder_->add(**frame));
}

void RgbdSink::ticked(const autonomy::TickOutcome& outcome) {
  if (!recorder_) return;
  note(recorder_->addTruth(outcome.now, vehicle_.trueT_map_body() * T_body_camera_));
}

void RgbdSink::note(const interfaces::Written& written) {
  if (written) return;
  failure_ = written.error().message;
  recorder_.reset();
}

}  // namespace swiftlet::apps
