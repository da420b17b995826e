// Figures as files show them.
#pragma once

namespace swiftlet::common {

/// `value` rounded to so many decimals, as the double that prints with no more of them: 30.563146064540703 -> 30.5631.
/// NaN and infinity stay what they are, and so does what is too large to have that many.
double rounded(double value, int decimals = 4);

}  // namespace swiftlet::common
