// Shows the progress of a long run and the time that is left: one line that is rewritten on a terminal, a line every
// few seconds otherwise.
#pragma once

#include <optional>
#include <string>

#include "apps/time_left.hpp"

namespace swiftlet::apps {

/// One thread at a time.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);

  /// The work done after this time, and the time left if it is known: "3 of 8 flights, about 1 h 20 min left".
  void update(const std::string& done, double wall_s, std::optional<double> left_s = {});
  /// The same of a run of which that share is done: " 40 %  120 scans, about 3 min left".
  void update(double share, const std::string& done, double wall_s);
  /// Call it before anything else is printed.
  void close();
  bool interactive() const { return interactive_; }

 private:
  bool quiet_, interactive_, open_ = false;
  double last_s_ = -1e9;
  TimeLeft time_left_;
};

}  // namespace swiftlet::apps
