// The flight's last events for the pages, each with its number.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "web/server/state_json.hpp"

namespace swiftlet::web {

/// Safe to use from any thread.
class EventFeed {
 public:
  /// More than a page shows without scrolling, so that a new page can be sent all that it shows.
  static constexpr std::size_t kKept = 200;

  void post(const common::Event& event);
  /// The kept events with a greater number, oldest first.
  std::vector<NumberedEvent> after(std::uint64_t number) const;

 private:
  mutable std::mutex mutex_;
  std::deque<NumberedEvent> events_;
  std::uint64_t count_ = 0;
};

}  // namespace swiftlet::web
