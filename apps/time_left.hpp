// The time that is left of a long run, from the share of its input that was taken.
#pragma once

#include <optional>

namespace swiftlet::apps {

/// Input is taken in blocks, such as those of a packed file: when one is taken, the one before it is done. The share
/// done is therefore that before the last step, as of that step; between steps the time runs down.
class TimeLeft {
 public:
  /// nullopt while it is unknown, and where the run lasts longer than expected. Neither argument decreases.
  std::optional<double> after(double share_taken, double wall_s) {
    if (share_taken > taken_) {
      done_ = taken_;
      taken_ = share_taken;
      step_s_ = wall_s;
    }
    // The first part may be that of a file that is opened, or of a map that is small.
    constexpr double kLeastShare = 0.02, kLeastWall_s = 2.0;
    if (done_ < kLeastShare || wall_s < kLeastWall_s) return std::nullopt;
    const double left_s = step_s_ / done_ - wall_s;
    return left_s > 0.0 ? std::optional(left_s) : std::nullopt;
  }

 private:
  double taken_ = 0.0, done_ = 0.0, step_s_ = 0.0;
};

}  // namespace swiftlet::apps
