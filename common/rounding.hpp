// Rounding of figures for files.
#pragma once

namespace swiftlet::common {

/// `value` rounded to `decimals` decimals, as the double that prints with no more: 30.563146064540703 -> 30.5631.
/// NaN, infinity and values too large to have that many decimals are returned unchanged.
double rounded(double value, int decimals = 4);

}  // namespace swiftlet::common
