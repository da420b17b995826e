// Shows the progress of a long run: one line that is rewritten on a terminal, a line every few seconds otherwise.
#pragma once

#include <string>

namespace swiftlet::apps {

/// One thread at a time.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);

  void update(const std::string& text, double wall_s);
  /// Call it before anything else is printed.
  void close();
  bool interactive() const { return interactive_; }

 private:
  bool quiet_, interactive_, open_ = false;
  double last_s_ = -1e9;
};

}  // namespace swiftlet::apps
