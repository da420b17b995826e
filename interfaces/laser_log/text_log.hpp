// Laser logs with one record a line.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "interfaces/files/line_reader.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/log_fields.hpp"

namespace swiftlet::interfaces {

/// The meaning of a line. Lines come in the order of the file.
class LogFormat {
 public:
  virtual ~LogFormat() = default;
  /// The scan of the line; nullopt for a line without one.
  virtual tl::expected<std::optional<LoggedScan>, RecordProblem> parse(std::string_view line) = 0;
  virtual std::string name() const = 0;
  virtual bool hasMicroseconds() const { return false; }
  /// Oddities of the lines so far.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// Limits: a log may have any length; a line longer than a scan of kMaxBeams ranges and remissions is not a scan.
constexpr LineLimits kLogLimits{std::size_t{1} << 20, std::numeric_limits<std::int64_t>::max(), true};

std::unique_ptr<LaserLog> openTextLog(const std::filesystem::path& file, std::unique_ptr<LogFormat> format);

}  // namespace swiftlet::interfaces
