#include "apps/numbers.hpp"

#include <charconv>

#include <fmt/format.h>

namespace swiftlet::apps {

CLI::Validator numberWithin(double low, double high) {
  const std::string bounds = fmt::format("{} to {}", low, high);
  const auto check = [low, high, bounds](std::string& text) -> std::string {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc{} && end == text.data() + text.size();
    return number && value >= low && value <= high ? "" : fmt::format("`{}` is not a number from {}", text, bounds);
  };
  return {check, bounds};
}

}  // namespace swiftlet::apps
