// What a trial shows while it flies: how many flights are over, which one is in the air, and how long the rest takes.
#pragma once

#include <mutex>
#include <string>

#include "apps/progress_line.hpp"
#include "flight/wall_clock.hpp"

namespace swiftlet::apps {

/// Safe from several threads. Its line is shown on a terminal alone: elsewhere the lines of the flights are enough.
class TrialProgress {
 public:
  /// The progress of this many flights.
  TrialProgress(int flights, bool quiet);

  /// A flight, as "levels seed 3", has been in the air for this long in simulated time.
  void flies(const std::string& flight, double simulated_s);
  /// Prints what a flight that is over came to.
  void over(const std::string& lines, bool passed);
  /// Takes the line away.
  void close();

 private:
  std::string text() const;

  int flights_, flown_ = 0, failed_ = 0;
  bool quiet_;
  std::string now_;            ///< The flight that was last heard of, with its time.
  double flown_wall_s_ = 0.0;  ///< When the last flight ended.
  std::mutex mutex_;
  ProgressLine line_;
  flight::Clock::time_point begin_ = flight::Clock::now();
};

}  // namespace swiftlet::apps
