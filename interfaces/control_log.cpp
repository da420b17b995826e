#include "interfaces/control_log.hpp"

#include <utility>

#include <fmt/format.h>

namespace swiftlet::interfaces {
namespace {

/// No quantity of a flight has a greater number, in the units of the log.
constexpr double kGreatest = 1e6;
constexpr double kMostBattery_v = 100.0;

}  // namespace

const LineFormat& controlLogFormat() {
  static const LineFormat kFormat{"tick",
                                  {"t",      "flying", "roll",   "pitch",   "yaw_rate", "thrust",  "tilt_cos", "yaw",
                                   "x",      "y",      "z",      "vx",      "vy",       "vz",      "battery",  "truth",
                                   "true_x", "true_y", "true_z", "true_vx", "true_vy",  "true_vz", "true_yaw"}};
  return kFormat;
}

std::string toLine(const ControlRow& row) {
  const Eigen::Vector3d &p = row.position_odom_m, &v = row.velocity_odom_m_s;
  const Eigen::Vector3d &tp = row.true_position_map_m, &tv = row.true_velocity_map_m_s;
  return fmt::format(
      "{} {:d} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.5f} {:.5f} {:.5f} {:.5f} {:.5f} {:.5f} {:.4f} "
      "{:d} {:.5f} {:.5f} {:.5f} {:.5f} {:.5f} {:.5f} {:.6f}\n",
      stampText(row.stamp), row.flying, row.roll_rad, row.pitch_rad, row.yaw_rate_rad_s, row.thrust, row.tilt_cos,
      row.yaw_odom_rad, p.x(), p.y(), p.z(), v.x(), v.y(), v.z(), row.battery_v, row.has_truth, tp.x(), tp.y(), tp.z(),
      tv.x(), tv.y(), tv.z(), row.true_yaw_map_rad);
}

tl::expected<ControlLogWriter, FileError> ControlLogWriter::create(const std::filesystem::path& file) {
  auto made = AppendFile::create(file);
  if (!made) return tl::unexpected(made.error());
  ControlLogWriter writer(std::move(*made));
  writer.block_ = "# ";
  for (const auto& field : controlLogFormat().fields) writer.block_ += std::string(field) + " ";
  writer.block_.back() = '\n';
  return writer;
}

Written ControlLogWriter::write(const ControlRow& row) {
  constexpr std::size_t kBlock = 16'384;
  block_ += toLine(row);
  return block_.size() < kBlock ? Written() : flush();
}

Written ControlLogWriter::flush() { return file_.append(std::exchange(block_, {})); }

std::vector<ControlRow> readControlLog(const std::filesystem::path& file) {
  LineReader reader(file);
  std::vector<Word> words;
  std::vector<ControlRow> rows;
  while (nextWords(reader, words)) {
    const LineFields fields(reader, words, controlLogFormat());
    const auto number = [&](std::size_t at) { return fields.numberWithin(at, kGreatest); };
    const auto vector = [&](std::size_t at) { return Eigen::Vector3d(number(at), number(at + 1), number(at + 2)); };
    ControlRow row;
    row.stamp = fields.stamp(0);
    if (!rows.empty() && row.stamp <= rows.back().stamp)
      throw fields.problemAt(0, "t", common::Message("control-log.not-later", "is not later than the line before"));
    row.flying = fields.flag(1);
    row.roll_rad = number(2);
    row.pitch_rad = number(3);
    row.yaw_rate_rad_s = number(4);
    row.thrust = fields.numberWithin(5, 0.0, 1.0);
    row.tilt_cos = fields.numberWithin(6, -1.0, 1.0);
    row.yaw_odom_rad = number(7);
    row.position_odom_m = vector(8);
    row.velocity_odom_m_s = vector(11);
    row.battery_v = fields.numberWithin(14, 0.0, kMostBattery_v);
    row.has_truth = fields.flag(15);
    row.true_position_map_m = vector(16);
    row.true_velocity_map_m_s = vector(19);
    row.true_yaw_map_rad = number(22);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace swiftlet::interfaces
