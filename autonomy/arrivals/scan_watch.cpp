#include "autonomy/arrivals/scan_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

/// The filter keeps the motion of one second (perception/fusion/state_history.cpp); the rest is for the scan's use.
constexpr double kOldest_s = 0.9;

}  // namespace

ScanWatch::Scan ScanWatch::take(Scan scan) {
  const common::Stamps& stamps = scan->stamps;
  clock_.add(stamps);
  sayTiming(stamps.arrived);
  if (repeats(*scan) || !clock_.isCredible(stamps)) return nullptr;
  const common::Time measured = clock_.measured(stamps);
  if ((stamps.arrived - measured).seconds() > kOldest_s) return nullptr;
  if (measured == stamps.measured) return scan;
  auto timed = std::make_shared<common::LaserScan>(*scan);
  timed->stamps.measured = measured;
  return timed;
}

void ScanWatch::sayTiming(common::Time now) {
  const ScanTiming timing = clock_.timing();
  if (std::exchange(said_, timing) == timing) return;
  const double ms = 1e3 * std::abs(clock_.shift_s());
  const char* side = clock_.shift_s() < 0.0 ? "ahead" : "behind";
  switch (timing) {
    case ScanTiming::kUsual:
      return log_.info(now, "laser", "the laser's scans come as at first");
    case ScanTiming::kLate:
      return log_.warn(
          now, "laser", "the laser's scans are late",
          fmt::format("{:.0f} ms later than at first; those older than {:.1f} s are rejected", ms, kOldest_s));
    case ScanTiming::kClockJumped:
      return log_.warn(now, "laser", "the laser's clock has jumped",
                       fmt::format("it is {:.0f} ms {}; the stamps are corrected", ms, side));
    case ScanTiming::kClockDrifts:
      return log_.warn(now, "laser", "the laser's clock drifts",
                       fmt::format("it is {:.0f} ms {} by now; the stamps are corrected", ms, side));
  }
}

/// Whether this scan repeats the one before it.
bool ScanWatch::repeats(const common::LaserScan& scan) {
  const bool any_return = std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [&scan](float range_m) {
    return range_m >= scan.range_min_m && range_m < scan.range_max_m;
  });
  const bool same = any_return && scan.ranges_m == last_ranges_m_;
  const common::Edge edge = repeats_.update(same, scan.stamps.arrived);
  if (edge == common::Edge::kEntered)
    log_.warn(scan.stamps.arrived, "laser", "the laser repeats its last scan", "repeated scans are rejected");
  if (edge == common::Edge::kLeft) log_.info(scan.stamps.arrived, "laser", "the laser measures again");
  if (!same) last_ranges_m_ = scan.ranges_m;
  return same;
}

}  // namespace swiftlet::autonomy
