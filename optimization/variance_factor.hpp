// By which factor the covariances are wrong, from squared innovations that should be chi-squared distributed: the
// variance factor of geodesy.
#pragma once

#include <vector>

namespace swiftlet::optimization {

/// Of values without gross errors, which may have a heavy tail: by the median, or by the mean without the greatest
/// tenth where that is larger. 1 where there are no values.
double varianceFactor(std::vector<double> squared, int degrees_of_freedom);

/// Greatest factor by which the squared innovations of right closures exceed their 95 % quantile.
inline constexpr double kTailRatio = 9.0;

/// The squared innovation beyond which a value is no part of these, whose tail may be heavy: kTailRatio times that
/// which 95 % are below, and at most 100 times the degrees of freedom and the variance factor.
double gateOf(std::vector<double> squared, int degrees_of_freedom);

}  // namespace swiftlet::optimization
