// Tells late scans from a laser's clock that has jumped or drifts.
//
// The lag of a scan, from its stamp to its arrival, is the time that its way takes, less what the laser's clock is
// ahead. When the lag changes, the turns of the laser's mirror tell which of the two has: they are as regular as a
// clock. Where the laser's clock has changed, its stamps have left the turns by as much. Where the way has, the stamps
// still lie whole turns apart, and one turn for each scan that comes.
#pragma once

#include <cstdint>
#include <deque>

#include "common/stamps.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

enum class ScanTiming { kUsual, kLate, kClockJumped, kClockDrifts };

/// One thread. What the laser's clock was off from the start on does not show.
class LaserClock {
 public:
  /// `period_s`: of a turn, by the data sheet.
  explicit LaserClock(double period_s) : period_s_(period_s) {}

  /// The stamps of each scan, in the order in which they arrive.
  void add(const common::Stamps& stamps);

  ScanTiming timing() const { return timing_; }
  /// By how much the lag is longer than usual.
  double shift_s() const { return shift_s_; }
  /// When the scan was measured, by the laser's clock as it was at first.
  common::Time measured(const common::Stamps& stamps) const;
  /// False if the scan arrives earlier than it can, so that its stamp is wrong by an unknown amount.
  bool isCredible(const common::Stamps& stamps) const;

 private:
  struct Arrival {
    common::Time arrived;
    double lag_s = 0.0;
    /// What the stamps are ahead of whole turns, and of one turn for each scan, since the first scan.
    double off_turns_s = 0.0, off_scans_s = 0.0;
  };
  double medianLag_s() const;
  void judge();
  bool isSteady() const;
  bool isByClock() const;
  double tolerance_s() const;

  double period_s_;
  std::deque<Arrival> recent_;  ///< The last one is the newest.
  common::Time newest_measured_;
  std::uint64_t learned_ = 0;               ///< Scans of which usual_s_ and scatter_s_ are made.
  double usual_s_ = 0.0, scatter_s_ = 0.0;  ///< The usual lag, and the mean deviation of a scan's from it.
  Arrival sound_;                           ///< Before the lag was last seen to be usual.
  double sound_shift_s_ = 0.0;              ///< What was its shift then.
  bool was_usual_ = true;                   ///< By the scan before the last.
  ScanTiming timing_ = ScanTiming::kUsual;
  double shift_s_ = 0.0;
};

}  // namespace swiftlet::autonomy
