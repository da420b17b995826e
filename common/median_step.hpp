// The usual time between the items of a series, which a few wrong stamps or gaps do not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/time.hpp"

namespace swiftlet::common {

/// The median of the steps between neighbours, in seconds; 0 for fewer than two items. `stampOf` takes an item.
template <typename Items, typename StampOf>
double medianStep_s(const Items& items, StampOf stampOf) {
  if (items.size() < 2) return 0.0;
  std::vector<double> steps_s;
  steps_s.reserve(items.size() - 1);
  for (std::size_t i = 1; i < items.size(); ++i)
    steps_s.push_back((stampOf(items[i]) - stampOf(items[i - 1])).seconds());
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return *middle;
}

}  // namespace swiftlet::common
