#include "interfaces/laser_log/text_log.hpp"

#include <algorithm>
#include <utility>

#include "interfaces/laser_log/counted_log.hpp"

namespace swiftlet::interfaces {
namespace {

class TextLog final : public CountedLog {
 public:
  TextLog(const std::filesystem::path& file, std::unique_ptr<LogFormat> format)
      : file_bytes_(static_cast<double>(std::filesystem::file_size(file))),
        reader_(file, kLogLimits),
        format_(std::move(format)) {}

  std::optional<LoggedScan> next() override {
    std::string_view line;
    while (reader_.next(line)) {
      if (reader_.lineCut()) {
        skip({0, "", common::Message("text.line-too-long", "a line of more than {} bytes", kLogLimits.line_bytes)});
        continue;
      }
      auto scan = format_->parse(line);
      if (!scan)
        skip(scan.error());
      else if (*scan)
        return counted(std::move(**scan));
    }
    return std::nullopt;
  }

  double progress() const override {
    return file_bytes_ > 0.0 ? std::min(1.0, static_cast<double>(reader_.packedBytesRead()) / file_bytes_) : 1.0;
  }
  std::string format() const override { return format_->name(); }
  bool hasMicroseconds() const override { return format_->hasMicroseconds(); }
  std::vector<std::string> notes() const override { return format_->notes(); }

 private:
  void skip(const RecordProblem& problem) {
    skipped({{reader_.name(), reader_.lineNumber(), problem.column}, problem.element, problem.message, ""});
  }

  double file_bytes_;
  LineReader reader_;
  std::unique_ptr<LogFormat> format_;
};

}  // namespace

std::unique_ptr<LaserLog> openTextLog(const std::filesystem::path& file, std::unique_ptr<LogFormat> format) {
  return std::make_unique<TextLog>(file, std::move(format));
}

}  // namespace swiftlet::interfaces
