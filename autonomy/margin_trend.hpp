// How the thrust margin falls with the charge: a straight line through what was measured lately.
#pragma once

#include <optional>

namespace swiftlet::autonomy {

/// One thread. The voltage of a lithium battery falls steeply from full, then about linearly with the charge, and so
/// does the greatest thrust; so what was measured at higher charges counts less and less. The bend near the end of the
/// charge is not foreseen.
class MarginTrend {
 public:
  void add(double remaining, double margin);
  /// The charge at which the margin will have fallen to `margin`; none before the charge has fallen enough to tell, or
  /// when the margin does not fall.
  std::optional<double> chargeAt(double margin) const;

 private:
  double weight_ = 0.0;
  double first_ = 0.0, last_ = 0.0;  ///< Charges.
  double mean_charge_ = 0.0, mean_margin_ = 0.0;
  double charge2_ = 0.0, charge_margin_ = 0.0;  ///< Sums of products of the deviations from the means.
};

}  // namespace swiftlet::autonomy
