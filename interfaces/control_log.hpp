// control.tsv of a run: commands, motion and battery at 100 Hz, and the truth where it is known. `swiftlet identify`
// and `swiftlet tune` read it. One line a tick with the columns of controlLogFormat(), `#` begins a comment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/line_fields.hpp"

namespace swiftlet::interfaces {

struct ControlRow {
  common::Time stamp;
  bool flying = false;                                                         ///< Neither taking off nor landing.
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rate_rad_s = 0.0, thrust = 0.0;  ///< The command.
  double tilt_cos = 1.0;                                                       ///< Cosine of the estimated tilt.
  double yaw_odom_rad = 0.0;
  Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  double battery_v = 0.0;
  bool has_truth = false;  ///< The rest is 0 without it.
  Eigen::Vector3d true_position_map_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d true_velocity_map_m_s = Eigen::Vector3d::Zero();
  double true_yaw_map_rad = 0.0;
};

const LineFormat& controlLogFormat();

/// One line with its newline.
std::string toLine(const ControlRow& row);

/// Writes blocks of about a second, each whole; what is left at the end by flush().
class ControlLogWriter {
 public:
  [[nodiscard]] static tl::expected<ControlLogWriter, FileError> create(const std::filesystem::path& file);
  [[nodiscard]] Written write(const ControlRow& row);
  [[nodiscard]] Written flush();

 private:
  explicit ControlLogWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
  std::string block_;
};

/// Throws InputError with file, line and column for a line that is not of the format, for numbers that no
/// flight has, and for stamps that do not rise.
std::vector<ControlRow> readControlLog(const std::filesystem::path& file);

}  // namespace swiftlet::interfaces
