#include "interfaces/laser_log/laser_log.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "interfaces/files/line_reader.hpp"
#include "interfaces/laser_log/carmen.hpp"

namespace swiftlet::interfaces {
namespace {

/// Lines within which a log shows what it is.
constexpr int kFirstLines = 1000;
constexpr LineLimits kLogLimits{std::size_t{4} << 20, std::numeric_limits<std::int64_t>::max()};

class CarmenLog final : public LaserLog {
 public:
  CarmenLog(const std::filesystem::path& file, const LaserLogOptions& options)
      : file_bytes_(static_cast<double>(std::filesystem::file_size(file))),
        reader_(file, kLogLimits),
        options_(options) {}

  std::optional<LoggedScan> next() override {
    std::string_view line;
    while (reader_.next(line)) {
      auto scan = parseCarmenLine(line, options_);
      if (!scan)
        skip(scan.error());
      else if (*scan)
        return count(std::move(**scan));
    }
    return std::nullopt;
  }

  const LaserLogCounts& counts() const override { return counts_; }
  double progress() const override {
    return file_bytes_ > 0.0 ? static_cast<double>(reader_.packedBytesRead()) / file_bytes_ : 1.0;
  }

 private:
  void skip(const LineProblem& problem) {
    ++counts_.skipped_records;
    if (counts_.first_problems.size() < LaserLogCounts::kProblemsKept)
      counts_.first_problems.push_back(
          {{reader_.name(), reader_.lineNumber(), problem.column}, problem.element, problem.message, "skipped"});
  }

  LoggedScan count(LoggedScan scan) {
    ++counts_.scans;
    for (const float range : scan.scan.ranges_m) counts_.invalid_ranges += std::isnan(range) ? 1 : 0;
    return scan;
  }

  double file_bytes_;
  LineReader reader_;
  LaserLogOptions options_;
  LaserLogCounts counts_;
};

bool looksLikeCarmen(const std::filesystem::path& file) {
  LineReader reader(file, kLogLimits);
  std::string_view line;
  for (int i = 0; i < kFirstLines && reader.next(line); ++i)
    if (isCarmenLine(line)) return true;
  return false;
}

}  // namespace

std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& file, const LaserLogOptions& options) {
  if (looksLikeCarmen(file)) return std::make_unique<CarmenLog>(file, options);
  throw common::InputError(common::Problem{
      {file.string(), 0, 0}, "", "not a laser log known here", "expected CARMEN text (FLASER or ROBOTLASER1 lines)"});
}

}  // namespace swiftlet::interfaces
