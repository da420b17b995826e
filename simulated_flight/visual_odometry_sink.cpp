#include "simulated_flight/visual_odometry_sink.hpp"

#include <memory>
#include <variant>

#include "common/whole_frame.hpp"

namespace swiftlet::simulated_flight {

void VisualOdometrySink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr) return;
  const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(event);
  if (frame == nullptr) return;
  ++frames_;
  if (!isWhole(**frame)) return;  // It counts as lost.
  const mapping3d::MappedFrame mapped = mapper_.add(**frame, {});
  if (mapped.pose.isTracked()) tracked_.push_back({mapped.pose.stamp, mapped.pose.scan, mapped.T_scan_camera});
}

evaluation::VisualOdometryRecord VisualOdometrySink::record() const {
  evaluation::VisualOdometryRecord record;
  record.frames = frames_;
  record.lost = frames_ - tracked_.size();
  const auto keys = mapper_.scans();
  for (const Tracked& frame : tracked_)
    record.body.push_back({frame.stamp, keys->T_map_level(frame.scan) * frame.T_scan_camera * T_camera_body_});
  return record;
}

}  // namespace swiftlet::simulated_flight
