#include "common/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace swiftlet::common {

void checkFailed(std::string_view condition, std::string_view file, int line, const std::string& values) {
  fmt::print(stderr, "{}:{}: check failed: {}{}{}\n", file, line, condition, values.empty() ? "" : " with", values);
  std::fflush(stderr);
  std::abort();
}

}  // namespace swiftlet::common
