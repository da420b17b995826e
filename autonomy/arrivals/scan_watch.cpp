#include "autonomy/arrivals/scan_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::autonomy {
namespace {

/// A single scan given twice is a hiccup of a link and needs no event.
constexpr int kRun = 2;

}  // namespace

bool ScanWatch::repeats(const common::LaserScan& scan) {
  const bool any_return = std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [&scan](float range_m) {
    return range_m >= scan.range_min_m && range_m < scan.range_max_m;
  });
  const bool same = any_return && scan.ranges_m == last_ranges_m_;
  const auto say = [&](common::Severity severity, std::string text) {
    events_.push_back({scan.stamps.arrived, severity, "laser", std::move(text), {}});
  };
  if (same) {
    if (++repeated_ == kRun) say(common::Severity::kWarning, "the laser repeats its last scan, which counts as none");
    return true;
  }
  if (repeated_ >= kRun) say(common::Severity::kInfo, "the laser measures again");
  repeated_ = 0;
  last_ranges_m_ = scan.ranges_m;
  return false;
}

std::vector<common::Event> ScanWatch::takeEvents() { return std::exchange(events_, {}); }

}  // namespace swiftlet::autonomy
