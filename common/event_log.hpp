// The events that the parts of the autonomy report, in the order in which they happen.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/event.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// Each part that reports events gets a reference at construction; the log must outlive the part. One thread.
class EventLog {
 public:
  void add(Event event) { events_.push_back(std::move(event)); }
  void info(Time now, std::string source, std::string text, std::string reason = {}) {
    add({now, Severity::kInfo, std::move(source), std::move(text), std::move(reason)});
  }
  void warn(Time now, std::string source, std::string text, std::string reason = {}, Concern concern = Concern::kNone) {
    add({now, Severity::kWarning, std::move(source), std::move(text), std::move(reason), {}, concern});
  }

  /// The events since the last call.
  std::vector<Event> take() { return std::exchange(events_, {}); }

 private:
  std::vector<Event> events_;
};

}  // namespace swiftlet::common
