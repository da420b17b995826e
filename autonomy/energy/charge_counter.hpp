// The charge of the battery by its fuel gauge, and by counting the current where the gauge is silent or stands still.
#pragma once

#include <limits>
#include <optional>

namespace swiftlet::autonomy {

/// One thread. Charges are shares of the full one, in [0, 1].
class ChargeCounter {
 public:
  /// The gauge stands still when it has not moved while this share of the capacity was drawn: a fault was noticed after
  /// 54 s (docs/decisions/fail_safes.md#079).
  static constexpr double kUnmoved = 0.05;

  /// `capacity_as`: that of the data sheet; it is corrected by what the gauge says in flight.
  explicit ChargeCounter(double capacity_as) : sheet_as_(capacity_as) {}

  /// The gauge's reading. Call it before takeOff() or draw() of the same sample.
  void read(double remaining);
  /// What was drawn before counts no longer: the battery may have been charged, or removed.
  void takeOff(double remaining);
  /// In flight: the current since the last sample. `measured`: by an ammeter.
  void draw(double current_a, double dt_s, bool measured);

  /// From the gauge since the last take-off; before that, from the data sheet.
  double capacity_as() const;
  /// The mean current by which the gauge has fallen to `remaining` since the take-off; nullopt while the drop is small.
  std::optional<double> meanCurrent_a(double remaining, double flown_s) const;
  bool standsStill() const { return drawn_since_move_as_ > kUnmoved * sheet_as_; }
  /// The gauge's last move less the charge that was drawn since, and less `more_as`.
  double counted(double more_as) const;

 private:
  double sheet_as_;
  double remaining_at_take_off_ = 0.0;
  double drawn_as_ = 0.0;                                      ///< By the measured current, since the last take-off.
  double moved_to_ = std::numeric_limits<double>::infinity();  ///< What the gauge said when it last moved.
  double drawn_at_move_as_ = 0.0;                              ///< What had been drawn until then.
  double drawn_since_move_as_ = 0.0;
};

}  // namespace swiftlet::autonomy
