#include "interfaces/laser_log/log_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;

constexpr std::size_t kShownBytes = 40;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Message withHint(Message message, const std::string& hint) { return hint.empty() ? message : message += "; " + hint; }

}  // namespace

std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, kShownBytes)) text += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > kShownBytes ? text + "..." : text;
}

void LogFields::skipBlanks() {
  while (at_ != end_ && isBlank(*at_)) ++at_;
}

bool LogFields::atEnd() {
  skipBlanks();
  return at_ == end_;
}

std::string_view LogFields::word(const char* name) {
  skipBlanks();
  const char* first = at_;
  while (at_ != end_ && !isBlank(*at_)) ++at_;
  if (first == at_) failAt(first, name, Message("laser-log.line-ends", "the line ends before it"));
  return {first, static_cast<std::size_t>(at_ - first)};
}

double LogFields::number(const char* name) {
  const std::string_view text = word(name);
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && rest == text.data() + text.size()) return value;
  failAt(text.data(), name,
         withHint(Message("text.not-a-number", "`{}` is not a number", shown(text)), decimalCommaHint(text)));
  return 0.0;
}

double LogFields::finite(const char* name) {
  skipBlanks();
  const char* first = at_;
  const double value = number(name);
  if (std::isfinite(value)) return value;
  const std::string_view text(first, static_cast<std::size_t>(at_ - first));
  failAt(first, name, Message("text.not-finite", "`{}` is not a finite number", shown(text)));
  return 0.0;
}

int LogFields::count(const char* name) {
  skipBlanks();
  const char* first = at_;
  const double value = number(name);
  if (value >= 0 && value <= kMaxBeams && value == std::floor(value)) return static_cast<int>(value);
  failAt(first, name, Message("laser-log.no-count", "{} is not a number of readings", value));
  return 0;
}

common::Pose2 LogFields::pose(const char* name) {
  skipBlanks();
  const char* first = at_;
  common::Pose2 pose;
  pose.x_m = finite(name);
  pose.y_m = finite(name);
  pose.yaw_rad = common::wrapAngle(finite(name));
  if (std::max(std::abs(pose.x_m), std::abs(pose.y_m)) <= kFarthest_m) return pose;
  failAt(first, name, Message("text.too-far", "is farther away than {} m", kFarthest_m));
  return {};
}

common::Time LogFields::stamp(const char* name) {
  const std::string_view text = word(name);
  const auto stamp = parseStamp(text);
  if (!stamp) {
    const std::string unit = stampUnitHint(text);
    failAt(text.data(), name,
           withHint(Message("text.not-a-time", "`{}` is not a time in seconds", shown(text)),
                    unit.empty() ? decimalCommaHint(text) : unit));
  }
  return stamp.value_or(common::Time());
}

void LogFields::ranges(int count, double unit_m, common::LaserScan& scan) {
  scan.ranges_m.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count && !problem_; ++i) scan.ranges_m.push_back(static_cast<float>(unit_m * number("range")));
}

void LogFields::failAt(const char* where, const char* name, Message message) {
  if (!problem_) problem_ = RecordProblem{static_cast<int>(where - begin_) + 1, name, std::move(message)};
  at_ = end_;
}

}  // namespace swiftlet::interfaces
