// The resident memory of this process.
#pragma once

#include "flight/wall_clock.hpp"

namespace swiftlet::flight {

/// The most since the object was made, without what the process needed before. One thread. Where the system does not
/// report it (no /proc), it is 0.
class MemoryWatch {
 public:
  MemoryWatch();
  /// To be called often: it looks some twenty times a second.
  void look();
  /// In 10^6 bytes. Exact if the process has never needed more before; otherwise the most that look() has seen.
  double peak_MB();

 private:
  double before_MB_;  ///< The most that the process had needed when the watch began.
  double seen_MB_ = 0.0;
  Clock::time_point next_;
};

}  // namespace swiftlet::flight
