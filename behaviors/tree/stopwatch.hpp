// Counts the time a node is under way; stands still while the node is suspended.
#pragma once

#include <cstdint>
#include <optional>

namespace swiftlet::tree {

class Stopwatch {
 public:
  void restart(std::int64_t now_ns) {
    counted_ns_ = 0;
    running_since_ns_ = now_ns;
  }
  void stop(std::int64_t now_ns) {
    counted_ns_ = elapsed_ns(now_ns);
    running_since_ns_.reset();
  }
  void resume(std::int64_t now_ns) {
    if (!running_since_ns_) running_since_ns_ = now_ns;
  }
  std::int64_t elapsed_ns(std::int64_t now_ns) const {
    return counted_ns_ + (running_since_ns_ ? now_ns - *running_since_ns_ : 0);
  }

 private:
  std::int64_t counted_ns_ = 0;
  std::optional<std::int64_t> running_since_ns_;
};

}  // namespace swiftlet::tree
