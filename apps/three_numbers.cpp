#include "apps/three_numbers.hpp"

#include <cmath>
#include <sstream>

namespace swiftlet::apps {

std::optional<std::array<double, 3>> threeNumbers(const std::string& text) {
  std::istringstream in(text);
  std::array<double, 3> numbers{};
  char first = 0, second = 0, rest = 0;
  in >> numbers[0] >> first >> numbers[1] >> second >> numbers[2];
  if (!in || first != ';' || second != ';' || in >> rest) return std::nullopt;
  if (!std::isfinite(numbers[0] + numbers[1] + numbers[2])) return std::nullopt;
  return numbers;
}

}  // namespace swiftlet::apps
