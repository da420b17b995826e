#include "web/server/event_feed.hpp"

#include <algorithm>

namespace swiftlet::web {

void EventFeed::post(const common::Event& event) {
  const std::scoped_lock lock(mutex_);
  events_.push_back({++count_, event});
  if (events_.size() > kKept) events_.pop_front();
}

std::vector<NumberedEvent> EventFeed::after(std::uint64_t number) const {
  const std::scoped_lock lock(mutex_);
  const auto first = std::find_if(events_.begin(), events_.end(),
                                  [number](const NumberedEvent& event) { return event.number > number; });
  return {first, events_.end()};
}

}  // namespace swiftlet::web
