// How long jobs took, beside how long they were declared to take.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/time.hpp"

namespace swiftlet::common {

/// The jobs of one kind, from submission to the end of the work.
struct JobTimes {
  std::string kind;
  int count = 0;
  int late = 0;       ///< How many took longer than was declared for them.
  Duration declared;  ///< Of the last one.
  Duration median;
  Duration p99;  ///< The least duration that at least 99 % of them kept.

  /// More than one in a hundred came later than the simulator promises.
  bool tooSlow() const { return p99 > declared; }
};

/// Collects them. Not safe for several threads.
class JobStopwatch {
 public:
  void add(const std::string& kind, Duration declared, Duration took);
  /// In alphabetical order of the kinds.
  std::vector<JobTimes> times() const;

 private:
  struct Kind {
    Duration declared;
    int late = 0;
    std::vector<Duration> took;
  };
  std::map<std::string, Kind> kinds_;
};

}  // namespace swiftlet::common
