// The counters that logs of all formats have.
#pragma once

#include <cmath>
#include <utility>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

class CountedLog : public LaserLog {
 public:
  const LaserLogCounts& counts() const final { return counts_; }

 protected:
  LoggedScan counted(LoggedScan logged) {
    ++counts_.scans;
    for (const float range_m : logged.scan.ranges_m) counts_.invalid_ranges += std::isnan(range_m) ? 1 : 0;
    return logged;
  }
  void skipped(common::Problem problem) {
    ++counts_.skipped_records;
    if (counts_.first_problems.size() >= LaserLogCounts::kProblemsKept) return;
    problem.hint = "skipped";
    counts_.first_problems.push_back(std::move(problem));
  }

 private:
  LaserLogCounts counts_;
};

}  // namespace swiftlet::interfaces
