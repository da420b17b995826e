// SWIFTLET_CHECK(condition, values...) states what the code itself guarantees. A failed check is a bug: it prints the
// condition, file and line, and the values given, and aborts. Never use it on sensor data or on input of the user.
#pragma once

#include <string>
#include <string_view>

#include <fmt/core.h>

namespace swiftlet::common {

[[noreturn]] void checkFailed(std::string_view condition, std::string_view file, int line, const std::string& values);

template <typename... Values>
std::string joinValues(const Values&... values) {
  std::string text;
  ((text += fmt::format(" {}", values)), ...);
  return text;
}

}  // namespace swiftlet::common

#define SWIFTLET_CHECK(condition, ...)                                                                              \
  do {                                                                                                              \
    if (!(condition)) [[unlikely]]                                                                                  \
      ::swiftlet::common::checkFailed(#condition, __FILE__, __LINE__, ::swiftlet::common::joinValues(__VA_ARGS__)); \
  } while (false)
