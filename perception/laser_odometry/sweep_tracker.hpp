// Finds the motion within each sweep of a slow laser from the sweeps alone. It looks two sweeps ahead: the motion at
// the beginning of a log shows only in what follows, and later sweeps make the end of one certain.
//
//   sweep --> turn rate that fits best --> fit of its motion --> fit of the sweeps before it, which now have a next one
//
// Where a sweep does not fit those around it, the track is lost: it is initialized again from the sweeps that follow.
#pragma once

#include <deque>
#include <optional>

#include "common/time.hpp"
#include "perception/laser_odometry/sweep_fit.hpp"

namespace swiftlet::perception {

/// Not thread-safe. Deterministic.
class SweepTracker {
 public:
  /// Takes in the next sweep, which begins at `start`.
  void add(std::vector<SweptPoint> points, common::Time start, double duration_s);
  /// No more sweeps come: all that are left can be taken.
  void finish();
  /// Whether a sweep can be taken.
  bool hasNext() const;
  /// The motion in the oldest sweep that was not taken; there must be one that can be. nullopt where the track
  /// was lost. In a frame that drifts, and is another one after each loss.
  std::optional<SweepMotion> take();
  /// How well the sweep that is taken next fits those around it: see fitOf(). 0 if the track was lost.
  double fitOfNext() const;

 private:
  struct Timed {
    Sweep sweep;
    common::Time start;
  };
  void begin();
  void follow();
  void refit(std::size_t index, bool with_next);
  void loseUnlessFitting(std::size_t first);
  OrientedPoints referenceWithout(std::size_t index) const;
  std::optional<SweepEnd> before(std::size_t index) const;
  std::optional<SweepEnd> after(std::size_t index) const;

  std::deque<Timed> sweeps_;  ///< Those that were taken, as far as they are needed, and those that were not.
  std::size_t taken_ = 0;     ///< Number of sweeps that were taken.
  std::size_t lost_ = 0;      ///< Sweeps before them that were not taken, and at which the track was lost.
  bool begun_ = false, finished_ = false;
};

}  // namespace swiftlet::perception
