// The current that flying draws: the current of hovering, and some for each metre a second of speed.
#pragma once

namespace swiftlet::autonomy {

/// One thread. Weighted least squares of the line current = hover + per_speed * speed, in which older samples count
/// exponentially less. As long as the speeds have differed little the slope is held near zero: a multirotor needs about
/// the same power whether it hovers or flies slowly.
class CurrentModel {
 public:
  void add(double current_a, double speed_m_s, double dt_s);
  /// The charge that a flight of this duration and length draws; zero before the first sample.
  double drawn_as(double duration_s, double length_m) const;

 private:
  // Weighted sums, normalized to a total weight of `weight_`.
  double weight_ = 0.0, speed_ = 0.0, current_ = 0.0, speed2_ = 0.0, product_ = 0.0;
};

}  // namespace swiftlet::autonomy
