#include "autonomy/arrivals/laser_clock.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "autonomy/arrivals/stamp_check.hpp"

namespace swiftlet::autonomy {
namespace {

/// Lags that differ by less are not judged: flights fail from 25 ms on (docs/envelope.md, the laser's clock).
constexpr double kOff_s = 0.02;
/// Twice the mean deviation of a lag that is spread evenly is half of its range, which its median never leaves.
constexpr double kScatter = 2.0;
/// The median is that of so long, and of so many scans at least: the hold begins 0.3 s after the last scan, and half of
/// them decide.
constexpr double kRecent_s = 0.25;
constexpr std::size_t kLeastScans = 5;
/// So many scans in a row agree when the way or the clock has changed for good.
constexpr std::ptrdiff_t kAgreeing = 3;
/// The usual lag is the median of the first scans, those of a second at 40 Hz.
constexpr std::uint64_t kFirstScans = 40;
/// Scans over which the period and the scatter are averaged.
constexpr std::uint64_t kMean = 1000;
/// What waits on a link has piled up or drained within this time. A lag that took longer to change is by a clock.
constexpr double kPilesUp_s = 5.0;

/// A clock that leaves the turns by more than this share of one within one does not drift, but jumps.
constexpr double kClockJump = 0.25;

}  // namespace

void LaserClock::add(const common::Stamps& stamps) {
  Arrival arrival{stamps.arrived, (stamps.arrived - stamps.measured).seconds()};
  if (learned_ < kFirstScans && stampFault(stamps, std::nullopt) != nullptr) return;
  if (!recent_.empty()) {
    const double step_s = (stamps.measured - newest_measured_).seconds();
    const double turns = std::round(step_s / period_s_);
    arrival.off_turns_s = recent_.back().off_turns_s + step_s - turns * period_s_;
    arrival.off_scans_s = recent_.back().off_scans_s + step_s - period_s_;
    if (was_usual_ && turns > 0.0)
      period_s_ += (step_s / turns - period_s_) / static_cast<double>(std::min(learned_ + 1, kMean));
  }
  newest_measured_ = stamps.measured;
  recent_.push_back(arrival);
  while (learned_ >= kFirstScans && recent_.size() > kLeastScans &&
         (stamps.arrived - recent_.front().arrived).seconds() > kRecent_s)
    recent_.pop_front();
  judge();
}

/// Of the recent scans, each as it would be by the clock of the newest: a clock that drifts shows at once.
double LaserClock::medianLag_s() const {
  std::vector<double> lags_s;
  lags_s.reserve(recent_.size());
  double drifted_s = 0.0;  // Since the scan.
  for (auto one = recent_.rbegin(); one != recent_.rend(); ++one) {
    lags_s.push_back(one->lag_s - drifted_s);
    if (std::next(one) == recent_.rend()) break;
    const double off_s = one->off_turns_s - std::next(one)->off_turns_s;
    if (std::abs(off_s) < kClockJump * period_s_) drifted_s += off_s;
  }
  const auto middle = lags_s.begin() + static_cast<std::ptrdiff_t>(lags_s.size() / 2);
  std::nth_element(lags_s.begin(), middle, lags_s.end());
  return *middle;
}

void LaserClock::judge() {
  const double median_s = medianLag_s();
  if (learned_ < kFirstScans) usual_s_ = median_s;
  shift_s_ = median_s - usual_s_;
  if (std::abs(shift_s_) > tolerance_s() && timing_ == ScanTiming::kUsual && isSteady()) {
    if (isByClock())
      timing_ = was_usual_ ? ScanTiming::kClockJumped : ScanTiming::kClockDrifts;
    else if (shift_s_ > 0.0)
      timing_ = ScanTiming::kLate;
    else  // The way has become shorter.
      usual_s_ = median_s, shift_s_ = 0.0;
  }
  if (std::abs(shift_s_) <= tolerance_s()) timing_ = ScanTiming::kUsual;
  was_usual_ = std::abs(shift_s_) <= 0.5 * tolerance_s();
  if (!was_usual_) return;
  sound_ = recent_.front();
  sound_shift_s_ = shift_s_;
  ++learned_;
  scatter_s_ +=
      (std::abs(recent_.back().lag_s - usual_s_) - scatter_s_) / static_cast<double>(std::min(learned_, kMean));
}

/// Whether the newest scans all show the shift. When scans are late no more, those on their way come between the
/// others.
bool LaserClock::isSteady() const {
  return std::all_of(recent_.rbegin(), recent_.rbegin() + std::min(kAgreeing, std::ssize(recent_)),
                     [this](const Arrival& one) {
                       return (one.lag_s - usual_s_) * shift_s_ > 0.5 * tolerance_s() * std::abs(shift_s_);
                     });
}

/// Whether the stamps have left the turns by more than half of what the lag has changed. A jump may be one of whole
/// turns, as lost scans are; a drift lasts longer than no scan is lost.
bool LaserClock::isByClock() const {
  const Arrival& newest = recent_.back();
  const double change_s = shift_s_ - sound_shift_s_;
  const auto explains = [change_s](double ahead_s) { return -ahead_s / change_s > 0.5; };
  return explains(newest.off_turns_s - sound_.off_turns_s) || explains(newest.off_scans_s - sound_.off_scans_s) ||
         (newest.arrived - sound_.arrived).seconds() > kPilesUp_s;
}

double LaserClock::tolerance_s() const { return kOff_s + kScatter * scatter_s_; }

common::Time LaserClock::measured(const common::Stamps& stamps) const {
  const bool by_clock = timing_ == ScanTiming::kClockJumped || timing_ == ScanTiming::kClockDrifts;
  return by_clock ? stamps.measured + common::Duration::fromSeconds(shift_s_) : stamps.measured;
}

bool LaserClock::isCredible(const common::Stamps& stamps) const {
  return learned_ < kFirstScans || (stamps.arrived - measured(stamps)).seconds() >= usual_s_ - tolerance_s();
}

}  // namespace swiftlet::autonomy
