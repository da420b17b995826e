// Trajectories in the format of the TUM benchmark: `t x y z qx qy qz qw`, seconds and metres, one pose a line, `#`
// begins a comment. Equal poses give equal bytes on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/line_fields.hpp"

namespace swiftlet::interfaces {

/// One line with its newline and nine decimals. The stamp is written from its nanoseconds, so that it reads back
/// exactly.
std::string toTumLine(const common::StampedPose& pose);

/// Writes as a stream. A pose that is not finite is left out.
class TumWriter {
 public:
  [[nodiscard]] static tl::expected<TumWriter, FileError> create(const std::filesystem::path& file);
  [[nodiscard]] Written write(const common::StampedPose& pose);

 private:
  explicit TumWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
};

/// `t x y z qx qy qz qw`.
const LineFormat& tumFormat();

/// Requirement on the stamps of a file.
enum class StampOrder {
  kGrowing,  ///< Each is later than the one before: the result is a common::Trajectory.
  kAny,      ///< They may repeat and go back, as in recorded logs; common::ordered makes a trajectory of them.
};

/// The poses in the order of the file, plain or compressed. Throws InputError with file, line and column for anything
/// that is not a pose (also a last line that was cut), for a rotation of length zero, or for a stamp that is not in the
/// required order. Rotations are normalized.
std::vector<common::StampedPose> readTum(const std::filesystem::path& file, StampOrder order = StampOrder::kGrowing);
/// Messages use `name` as the file.
std::vector<common::StampedPose> parseTum(std::string_view text, const std::string& name,
                                          StampOrder order = StampOrder::kGrowing);

}  // namespace swiftlet::interfaces
