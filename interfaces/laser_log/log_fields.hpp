// The words of one line of a laser log, taken one after the other.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::interfaces {

/// Greatest number of readings of one scan: more than any laser has.
constexpr int kMaxBeams = 20'000;

/// Why a record could not be read, and where in its line.
struct RecordProblem {
  int column = 0;  ///< Counted from 1; 0 for formats without lines.
  std::string element;
  common::Message message;
};

/// A word of a log for messages: short, and without control characters.
std::string shown(std::string_view word);

/// The first word that is not as expected becomes the line's problem; all later values are zero.
class LogFields {
 public:
  /// The line must outlive this.
  explicit LogFields(std::string_view line) : begin_(line.data()), at_(begin_), end_(begin_ + line.size()) {}

  std::string_view word(const char* name);
  double number(const char* name);
  double finite(const char* name);
  int count(const char* name);
  /// Three numbers; x and y are within kFarthest_m.
  common::Pose2 pose(const char* name);
  common::Time stamp(const char* name);
  /// `count` ranges, each multiplied by `unit_m`.
  void ranges(int count, double unit_m, common::LaserScan& scan);

  bool atEnd();
  /// Sets the line's problem, unless it has one.
  void fail(const char* name, common::Message message) { failAt(at_, name, std::move(message)); }
  const std::optional<RecordProblem>& problem() const { return problem_; }

 private:
  void skipBlanks();
  void failAt(const char* where, const char* name, common::Message message);

  const char* begin_;
  const char* at_;
  const char* end_;
  std::optional<RecordProblem> problem_;
};

}  // namespace swiftlet::interfaces
