#include "perception/people/background_map.hpp"

#include <utility>

namespace swiftlet::perception {

void BackgroundMap::add(common::Time stamp, std::shared_ptr<const common::OccupancyGrid> grid) {
  history_.push_back({stamp, std::move(grid)});
}

std::shared_ptr<const common::OccupancyGrid> BackgroundMap::at(common::Time now) {
  while (history_.size() > 1 && history_[1].stamp <= now - age_) history_.pop_front();
  return history_.empty() ? nullptr : history_.front().grid;
}

}  // namespace swiftlet::perception
