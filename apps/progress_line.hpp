// Shows the progress of a long run and the time that is left: one line that is rewritten on a terminal, a line every
// few seconds otherwise.
#pragma once

#include <optional>
#include <string>

namespace swiftlet::apps {

/// Of a run of which that share is done after so long; none before it can be told.
std::optional<double> timeLeft_s(double share, double wall_s);

/// "about 40 s left", "about 3 min left", "about 1 h 20 min left".
std::string leftText(double left_s);

/// One thread at a time.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);

  void update(const std::string& text, double wall_s, std::optional<double> left_s = {});
  /// Call it before anything else is printed.
  void close();
  bool interactive() const { return interactive_; }

 private:
  bool quiet_, interactive_, open_ = false;
  double last_s_ = -1e9;
};

}  // namespace swiftlet::apps
