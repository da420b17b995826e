// The words of one line of a laser log, taken one after the other.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::interfaces {

/// Readings of one scan at most: more than any laser has.
constexpr int kMaxBeams = 20'000;

/// Why a record could not be read, and where in its line.
struct RecordProblem {
  int column = 0;  ///< Counted from 1; 0 where there are no lines.
  std::string element;
  std::string message;
};

/// A word of a log as it may be printed: short, and without what a terminal would act on.
std::string shown(std::string_view word);

/// Once one word is not what it should be, that is the line's problem, and what follows is zero.
class LogFields {
 public:
  /// The line outlives this.
  explicit LogFields(std::string_view line) : begin_(line.data()), at_(begin_), end_(begin_ + line.size()) {}

  std::string_view word(const char* name);
  double number(const char* name);
  double finite(const char* name);
  int count(const char* name);
  /// Three numbers; x and y within kFarthest_m.
  common::Pose2 pose(const char* name);
  common::Time stamp(const char* name);
  /// So many ranges, each times `unit_m`.
  void ranges(int count, double unit_m, common::LaserScan& scan);

  bool atEnd();
  /// Makes this the line's problem, unless there is one.
  void fail(const char* name, std::string message) { failAt(at_, name, std::move(message)); }
  const std::optional<RecordProblem>& problem() const { return problem_; }

 private:
  void skipBlanks();
  void failAt(const char* where, const char* name, std::string message);

  const char* begin_;
  const char* at_;
  const char* end_;
  std::optional<RecordProblem> problem_;
};

}  // namespace swiftlet::interfaces
