#include "flight/run_record.hpp"

#include <utility>

#include <fmt/format.h>

#include "interfaces/run_files.hpp"

namespace swiftlet::flight {

RunRecord::RunRecord(const FlightSetup& setup, interfaces::RunInfo info, const std::filesystem::path& folder,
                     const MotionReference* reference)
    : setup_(setup),
      folder_(folder, std::move(info), setup.system.namingKeptSheets().toYaml(true)),
      folder_sink_(folder_),
      control_log_(setup.control_log ? std::make_unique<ControlLogSink>(folder_.path(), reference) : nullptr),
      rgbd_(setup.record_rgbd ? std::make_unique<RgbdSink>(folder_.path(), reference) : nullptr),
      pictures_(folder_, reference, setup.system.vehicle.hull_diameter_m),
      map3d_(folder_),
      recognition_(folder_, setup.places) {}

std::vector<autonomy::FlightSink*> RunRecord::sinks() {
  std::vector<autonomy::FlightSink*> all = {&folder_sink_};
  if (control_log_) all.push_back(control_log_.get());
  if (rgbd_) all.push_back(rgbd_.get());
  all.push_back(&recognition_);
  all.push_back(&pictures_);
  all.push_back(&map3d_);
  return all;
}

void RunRecord::writeLast(const common::World& world) {
  recognition_.writeNow(world);
  pictures_.drawNow(world);
  map3d_.writeNow(world);
  if (control_log_) control_log_->finish();
}

void RunRecord::finish(const autonomy::VehicleMemory& learned, interfaces::FlightEnd end) {
  if (const std::size_t frames = rgbd_ ? rgbd_->leftOut() : 0; frames > 0)
    end.figures.push_back({"rgbd_frames_not_recorded", static_cast<double>(frames)});
  if (setup_.memory.kept) keepMemory(learned, end);
  folder_.finish(end);
}

/// A crash contains no lesson for the next flight.
void RunRecord::keepMemory(const autonomy::VehicleMemory& learned, interfaces::FlightEnd& end) {
  end.vehicle_memory_yaml = toYaml(learned);
  if (setup_.memory.file.empty() || end.outcome == interfaces::Outcome::kCrashed) return;
  if (const auto written = writeVehicleMemory(setup_.memory.file, learned); !written)
    memory_failure_ =
        fmt::format("--vehicle-memory: cannot be written: {}; what was learned is in {}",
                    written.error().message.text(), (folder_.path() / interfaces::kMemoryLearnedFile).string());
}

std::optional<std::string> RunRecord::failure() const {
  if (memory_failure_) return memory_failure_;
  if (folder_.failure()) return folder_.failure();
  if (control_log_ && control_log_->failure()) return control_log_->failure();
  return rgbd_ ? rgbd_->failure() : std::nullopt;
}

}  // namespace swiftlet::flight
