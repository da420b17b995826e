#include "apps/start_option.hpp"

#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"

namespace swiftlet::apps {
namespace {

/// The numbers between semicolons, or else commas, or else blanks; empty if there is anything else. Beside semicolons
/// and blanks a comma would be that of a decimal.
std::vector<double> numbersIn(const std::string& text) {
  const bool semicolons = text.find(';') != std::string::npos, commas = text.find(',') != std::string::npos;
  const char separator = semicolons ? ';' : commas ? ',' : ' ';
  std::vector<double> numbers;
  const char *at = text.data(), *const end = text.data() + text.size();
  const auto skipBlanks = [&] {
    while (at != end && *at == ' ') ++at;
  };
  for (skipBlanks(); at != end; skipBlanks()) {
    const auto [behind, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc{}) return {};
    at = behind;
    if (separator != ' ') skipBlanks();
    if (at != end && *at++ != separator) return {};
  }
  return numbers;
}

}  // namespace

simulation::StartConfig parseStart(const std::string& text) {
  std::vector<double> numbers = numbersIn(text);
  if (numbers.size() == 2) numbers.push_back(0.0);
  if (numbers.size() == 3) numbers.insert(numbers.begin() + 2, 0.0);
  simulation::StartConfig start;
  if (numbers.size() == 4) start = {false, numbers[0], numbers[1], numbers[2], numbers[3]};
  constexpr double kMost_m = 1e4;
  for (const double number : numbers)
    if (!(number >= -kMost_m && number <= kMost_m)) start.from_world = true;
  if (start.from_world)
    throw common::InputError(common::Problem{{},
                                             "--start",
                                             fmt::format("`{}` is not a place x;y;yaw in metres and degrees", text),
                                             "expected is for example --start \"1.5;-2;90\", decimals with a point"});
  return start;
}

}  // namespace swiftlet::apps
