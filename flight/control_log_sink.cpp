#include "flight/control_log_sink.hpp"

#include <utility>

#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"
#include "flight/motion_reference.hpp"

namespace swiftlet::flight {

ControlLogSink::ControlLogSink(const std::filesystem::path& run, const MotionReference* reference)
    : reference_(reference) {
  auto made = interfaces::ControlLogWriter::create(run / "control.tsv");
  if (made)
    writer_ = std::move(*made);
  else
    failure_ = made.error().message.text();
  auto tape = interfaces::AppendFile::create(run / "fusion.tsv");
  if (tape)
    tape_ = std::move(*tape);
  else
    failure_ = tape.error().message.text();
}

void ControlLogSink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr) return;
  if (const auto* battery = std::get_if<common::BatterySample>(event)) battery_v_ = battery->voltage_v;
  if (const auto* pilot = std::get_if<common::PilotSample>(event)) pilot_flies_ = pilot->takes_over;
}

void ControlLogSink::world(const std::shared_ptr<const common::World>& world) {
  flying_ = world->vehicle->flight_state == common::FlightState::kFlying;
}

void ControlLogSink::ticked(const autonomy::TickOutcome& outcome) {
  if (!writer_ || !common::isFinite(outcome.state.T_odom_body) || !outcome.state.velocity_odom_m_s.allFinite()) return;
  interfaces::ControlRow row;
  row.stamp = outcome.now;
  row.flying = flying_ && !pilot_flies_;
  row.roll_rad = outcome.setpoint.roll_rad;
  row.pitch_rad = outcome.setpoint.pitch_rad;
  row.yaw_rate_rad_s = outcome.setpoint.yaw_rate_rad_s;
  row.thrust = outcome.setpoint.thrust;
  const common::Pose3& estimate = outcome.state.T_odom_body;
  row.tilt_cos = (estimate.rotation * Eigen::Vector3d::UnitZ()).z();
  row.yaw_odom_rad = common::yawOf(estimate.rotation);
  row.position_odom_m = estimate.position_m;
  row.velocity_odom_m_s = outcome.state.velocity_odom_m_s;
  row.battery_v = battery_v_;
  if (reference_ != nullptr) {
    const common::Pose3 truth = reference_->T_map_body();
    row.has_truth = true;
    row.true_position_map_m = truth.position_m;
    row.true_velocity_map_m_s = reference_->velocity_map_m_s();
    row.true_yaw_map_rad = common::yawOf(truth.rotation);
  }
  note(writer_->write(row));
}

void ControlLogSink::heard(const perception::FilterInput& input) {
  constexpr std::size_t kBlock = 16'384;
  if (!tape_) return;
  tape_block_ += perception::toLine(input);
  if (tape_block_.size() < kBlock) return;
  note(tape_->append(tape_block_));
  tape_block_.clear();
}

void ControlLogSink::finish() {
  if (writer_) note(writer_->flush());
  if (tape_) note(tape_->append(std::exchange(tape_block_, {})));
}

void ControlLogSink::note(const interfaces::Written& written) {
  if (written) return;
  failure_ = written.error().message.text();
  writer_.reset();
  tape_.reset();
}

}  // namespace swiftlet::flight
