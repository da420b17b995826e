#include "common/validation.hpp"

#include <fmt/format.h>

namespace swiftlet::common {

Validation& Validation::within(std::string_view name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    problems_.push_back(fmt::format("{}: {} is not within {} and {}", name, value, low, high));
  return *this;
}

Validation& Validation::positive(std::string_view name, double value) {
  if (!(value > 0.0)) problems_.push_back(fmt::format("{}: {} is not positive", name, value));
  return *this;
}

Validation& Validation::require(bool condition, std::string_view name, std::string_view message) {
  if (!condition) problems_.push_back(fmt::format("{}: {}", name, message));
  return *this;
}

}  // namespace swiftlet::common
