// How long jobs took, compared with their declared latency.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/time.hpp"

namespace swiftlet::common {

/// The durations of the jobs of one kind, from submission to the end of the work.
struct JobTimes {
  std::string kind;
  int count = 0;
  int late = 0;       ///< Number of jobs that took longer than declared.
  Duration declared;  ///< Declared latency of the last job.
  Duration median;
  Duration p99;  ///< The least duration that at least 99 % of the jobs did not exceed.

  /// True if more than 1 % of the jobs took longer than the declared latency, at which the simulator delivers them.
  bool tooSlow() const { return p99 > declared; }
};

/// Collects the durations of jobs. Not thread-safe.
class JobStopwatch {
 public:
  void add(const std::string& kind, Duration declared, Duration took);
  /// One entry for each kind, in alphabetical order.
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
