#include "apps/listed_numbers.hpp"

#include <cmath>
#include <sstream>

namespace swiftlet::apps {

std::vector<double> listedNumbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (char separator = ';'; in; in >> separator) {
    if (separator != ';' || !(in >> numbers.emplace_back()) || !std::isfinite(numbers.back())) return {};
  }
  return numbers;
}

}  // namespace swiftlet::apps
