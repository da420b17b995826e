#include "apps/start_option.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "apps/listed_numbers.hpp"
#include "common/error.hpp"

namespace swiftlet::apps {

simulation::StartConfig parseStart(const std::string& text) {
  constexpr double kMost = 1e4;  // Metres, or degrees.
  std::vector<double> numbers = listedNumbers(text);
  if (numbers.size() == 2) numbers.push_back(0.0);
  if (numbers.size() == 3) numbers.insert(numbers.begin() + 2, 0.0);
  const bool in_bounds =
      std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::abs(number) <= kMost; });
  if (numbers.size() != 4 || !in_bounds)
    throw common::InputError(
        {}, "--start", common::Message("start.no-place", "`{}` is not a place x;y;yaw in metres and degrees", text),
        "for instance --start \"1.5;-2;90\", decimals with a point");
  return {false, numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace swiftlet::apps
