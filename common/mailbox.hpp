// Exchange between threads: the newest value for telemetry, a lossless queue for commands and their results.
#pragma once

#include <cstdint>
#include <deque>
#include <iterator>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace swiftlet::common {

/// Holds the newest value; a reader that is late misses the older ones. Any thread may post and read.
template <typename Value>
class LatestValue {
 public:
  void post(std::shared_ptr<const Value> value) {
    const std::scoped_lock lock(mutex_);
    value_ = std::move(value);
    ++sequence_;
  }
  /// Null until the first post.
  std::shared_ptr<const Value> read() const {
    const std::scoped_lock lock(mutex_);
    return value_;
  }
  /// Number of values posted so far, by which a reader detects a new one.
  std::uint64_t sequence() const {
    const std::scoped_lock lock(mutex_);
    return sequence_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Value> value_;
  std::uint64_t sequence_ = 0;
};

/// First in, first out, nothing lost. Any thread may push and take.
template <typename Value>
class LosslessQueue {
 public:
  void push(Value value) {
    const std::scoped_lock lock(mutex_);
    values_.push_back(std::move(value));
  }
  /// Removes and returns all values in the queue, oldest first. Does not wait.
  std::vector<Value> takeAll() {
    const std::scoped_lock lock(mutex_);
    std::vector<Value> taken(std::make_move_iterator(values_.begin()), std::make_move_iterator(values_.end()));
    values_.clear();
    return taken;
  }

 private:
  std::mutex mutex_;
  std::deque<Value> values_;
};

}  // namespace swiftlet::common
