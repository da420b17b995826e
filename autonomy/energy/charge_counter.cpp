#include "autonomy/energy/charge_counter.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

/// From this drop of the gauge on, the gauge shows the capacity better than the data sheet.
constexpr double kTellingDrop = 0.05;
/// A gauge has moved by more than this. Coarse ones move by 1 %.
constexpr double kMoved = 0.002;

}  // namespace

void ChargeCounter::read(double remaining) {
  if (!(std::abs(remaining - moved_to_) > kMoved)) return;
  moved_to_ = remaining;
  drawn_at_move_as_ = drawn_as_;
  drawn_since_move_as_ = 0.0;
}

void ChargeCounter::takeOff(double remaining) {
  remaining_at_take_off_ = moved_to_ = remaining;
  drawn_as_ = drawn_at_move_as_ = drawn_since_move_as_ = 0.0;
}

void ChargeCounter::draw(double current_a, double dt_s, bool measured) {
  if (measured) drawn_as_ += current_a * dt_s;
  drawn_since_move_as_ += current_a * dt_s;
}

double ChargeCounter::capacity_as() const {
  const double drop = remaining_at_take_off_ - moved_to_;
  return drop > kTellingDrop && drawn_at_move_as_ > 0.0 ? drawn_at_move_as_ / drop : sheet_as_;
}

std::optional<double> ChargeCounter::meanCurrent_a(double remaining, double flown_s) const {
  const double drop = remaining_at_take_off_ - remaining;
  if (!(drop > kTellingDrop && flown_s > 0.0)) return std::nullopt;
  return drop * sheet_as_ / flown_s;
}

double ChargeCounter::counted(double more_as) const {
  return std::max(0.0, moved_to_ - (drawn_since_move_as_ + more_as) / capacity_as());
}

}  // namespace swiftlet::autonomy
