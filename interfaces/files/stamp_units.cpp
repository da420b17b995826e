#include "interfaces/files/stamp_units.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/time.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

struct Unit {
  const char* name;
  const char* per_s;
  double since_1970;    ///< Stamps from 1998 to 2112 are between this and five times this.
  double least_step_s;  ///< Steps of sensors of 0.5 to 100 Hz in this unit, taken for seconds, are at least this.
};

/// From the largest number to the smallest.
constexpr std::array<Unit, 3> kUnits{
    {{"nanoseconds", "1e9", 9e17, 1e6}, {"microseconds", "1e6", 9e14, 2e3}, {"milliseconds", "1e3", 9e11, 10.0}}};

}  // namespace

std::string stampUnitHint(std::string_view word) {
  double stamp = 0.0;
  if (!parseNumber(word, stamp) || std::abs(stamp) <= common::kFarthestStamp_s) return "";
  for (const Unit& unit : kUnits)
    if (stamp >= unit.since_1970 && stamp <= 5.0 * unit.since_1970)
      return fmt::format("it looks like {} since 1970: divide the stamps by {}", unit.name, unit.per_s);
  return "if the stamps are nanoseconds, divide them by 1e9; by 1e6 or 1e3 if they are micro- or milliseconds";
}

std::string stampStepNote(double median_step_s) {
  for (const Unit& unit : kUnits)
    if (median_step_s >= unit.least_step_s)
      return fmt::format("the stamps are {:g} s apart in the median: are they {}? Then divide them by {}",
                         median_step_s, unit.name, unit.per_s);
  return "";
}

std::string microsecondStepNote(double median_step_s) {
  constexpr double kLeast_s = 5e-4, kMost_s = 10.0;  // No laser turns as fast, or as slowly.
  if (median_step_s <= 0.0 || (median_step_s >= kLeast_s && median_step_s < kMost_s)) return "";
  const double step = 1e6 * median_step_s;
  const char* unit = step >= 1e6 ? "nanoseconds? Then divide them by 1e3"
                     : step > 5  ? "milliseconds? Then multiply them by 1e3"
                                 : "seconds? Then multiply them by 1e6";
  return fmt::format("the stamps are {:g} apart in the median, where this format has microseconds: are they {}", step,
                     unit);
}

}  // namespace swiftlet::interfaces
