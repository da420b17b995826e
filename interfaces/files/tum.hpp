// Trajectories as the TUM benchmark writes them: `t x y z qx qy qz qw`, seconds and metres, one pose a line, `#` begins
// a comment. Equal poses give equal bytes on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/trajectory.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// One line with its newline; nine decimals. The stamp is written from its nanoseconds, so that it reads back exactly.
std::string toTumLine(const common::StampedPose& pose);

/// Writes as it goes. A pose that is not finite is left out.
class TumWriter {
 public:
  [[nodiscard]] static tl::expected<TumWriter, FileError> create(const std::filesystem::path& file);
  [[nodiscard]] Written write(const common::StampedPose& pose);

 private:
  explicit TumWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
};

/// Throws InputError with file, line and column for anything that is not a pose, a rotation of length zero, or a stamp
/// that does not come after the one before. Rotations are normalized. A last line without its newline that is not
/// whole is left out: its writer was killed.
common::Trajectory readTum(const std::filesystem::path& file);
/// `name` stands for the file in messages.
common::Trajectory parseTum(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
