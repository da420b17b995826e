#include "common/job_times.hpp"

#include <algorithm>

namespace swiftlet::common {
namespace {

/// The least value that at least `percent` % of the sorted values do not exceed.
Duration quantile(const std::vector<Duration>& sorted, std::size_t percent) {
  const std::size_t rank = (sorted.size() * percent + 99) / 100;
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

void JobStopwatch::add(const std::string& kind, Duration declared, Duration took) {
  Kind& all = kinds_[kind];
  all.declared = declared;
  if (took > declared) ++all.late;
  all.took.push_back(took);
}

std::vector<JobTimes> JobStopwatch::times() const {
  std::vector<JobTimes> result;
  for (const auto& [name, kind] : kinds_) {
    std::vector<Duration> sorted = kind.took;
    std::sort(sorted.begin(), sorted.end());
    JobTimes times;
    times.kind = name;
    times.count = static_cast<int>(sorted.size());
    times.late = kind.late;
    times.declared = kind.declared;
    times.median = quantile(sorted, 50);
    times.p99 = quantile(sorted, 99);
    result.push_back(std::move(times));
  }
  return result;
}

}  // namespace swiftlet::common
