// How much processor time jobs take. The measurement does not affect the jobs: they are delivered as without it.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/jobs.hpp"

namespace swiftlet::flight {

/// The processor time of this thread so far: what else the computer does is not counted.
double processorMs();

/// All functions may be called from any thread.
class JobMeter {
 public:
  void add(const std::string& kind, double took_ms);

  struct Ends {
    double first_ms = 0.0;
    double last_ms = 0.0;
  };
  /// The medians of the first and of the last tenth of all jobs of a kind; nullopt with fewer than ten.
  std::optional<Ends> ends(const std::string& kind) const;
  /// Of all jobs of a kind, in their order.
  std::vector<double> took_ms(const std::string& kind) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<double>> took_ms_;
};

/// A runner that runs the jobs by `jobs` and adds each job's processor time to the meter when its work is done.
std::unique_ptr<common::JobRunner> timed(std::unique_ptr<common::JobRunner> jobs, std::shared_ptr<JobMeter> meter);

}  // namespace swiftlet::flight
