#include "evaluation/judge.hpp"

#include <cmath>

#include <fmt/format.h>

namespace swiftlet::evaluation {

void Judge::atMost(const char* name, const std::optional<double>& value, double bound) {
  if (std::isinf(bound)) return;
  if (!value) return fail(fmt::format("{}: not measured, at most {:g} was asked for", name, bound));
  if (!(*value <= bound)) fail(fmt::format("{}: {:.3f}, at most {:g} was asked for", name, *value, bound));
}

void Judge::atLeast(const char* name, const std::optional<double>& value, double bound, const std::string& missing) {
  if (bound <= 0) return;
  if (!value)
    return fail(fmt::format("{}: not measured{}{}, at least {:g} was asked for", name, missing.empty() ? "" : ": ",
                            missing, bound));
  if (!(*value >= bound)) fail(fmt::format("{}: {:.4f}, at least {:g} was asked for", name, *value, bound));
}

}  // namespace swiftlet::evaluation
