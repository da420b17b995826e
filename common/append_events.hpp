// Events of several parts in one list.
#pragma once

#include <iterator>
#include <utility>
#include <vector>

#include "common/event.hpp"

namespace swiftlet::common {

/// Moves `more` behind `events`.
inline void append(std::vector<Event>& events, std::vector<Event> more) {
  std::move(more.begin(), more.end(), std::back_inserter(events));
}

}  // namespace swiftlet::common
