// One explanation of what the beams down have measured: which surfaces are below, whether the ground slopes, and the
// height, vertical speed and accelerometer bias that follow. Private to altitude.
//
//   x = (z, v_z, b | gradient of the sloping surface, 2 | heights of up to three surfaces)
//
// A beam measures d = z - h_i - gradient * (place - where the slope began). The heights of surfaces are part of the
// state, so that what is measured against a surface is never more certain than the surface is, and a surface of unknown
// height still measures how the height changes.
#pragma once

#include <array>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/height_measurement.hpp"

namespace swiftlet::perception::altitude {

inline constexpr int kNoLevel = -1;
inline constexpr int kFloor = 0;
inline constexpr int kSurfaces = 3;

/// What is below, or was a moment ago.
struct Surface {
  int serial = 0;  ///< Counts the surfaces; 0: none.
  int level = kNoLevel;
  int denied_level = kNoLevel;  ///< A level that it was compared with, and is not.
  bool slopes = false;
  Eigen::Vector2d sloped_from_map_m = Eigen::Vector2d::Zero();
  common::Time first = {}, last = {};  ///< When it was seen.
  int scans = 0;
  int sight = 0;  ///< Its number among the surfaces of the last scan that saw it.

  bool isSeen(common::Time scan) const { return serial != 0 && last == scan; }
  void seenAgain(common::Time now, int number) {
    last = now;
    sight = number;
    ++scans;
  }
};

class GroundHypothesis {
 public:
  /// Over the take-off floor, which gets the number `serial`.
  GroundHypothesis(const VerticalState& state, common::Time now, int serial);

  double log_weight = 0.0;
  bool restless = false;  ///< The accelerometer's bias changes fast.
  std::array<Surface, kSurfaces> surfaces;

  VerticalState vertical() const;
  void assume(const VerticalState& state);  ///< The surfaces keep their distance below.
  double height_m(int surface) const { return state_[at(surface)]; }
  double variance_m2(int surface) const { return covariance_(at(surface), at(surface)); }
  int slopingSurface() const;  ///< -1 without one.
  Eigen::Vector2d gradient() const { return state_.segment<2>(kGradient); }
  Eigen::Vector2d gradientVariance() const { return covariance_.diagonal().segment<2>(kGradient); }

  void predict(double dt_s, const InertialClimb& climb, bool at_rest);

  struct Innovation {
    double residual = 0.0, variance = 1.0;
    double squaredMahalanobis() const { return residual * residual / variance; }
    double logDensity() const;
  };
  /// Of a distance down to a surface of this hypothesis, or to one of a height that is known from elsewhere.
  Innovation innovation(int surface, const Eigen::Vector2d& place_map_m, double distance_m, double variance_m2) const;
  Innovation innovationOver(double height_m, double distance_m, double variance_m2) const;
  Innovation innovationOfHeight(int surface, double height_m, double variance_m2) const;

  void measure(int surface, const Eigen::Vector2d& place_map_m, double distance_m, double variance_m2);
  /// The surface is found to be at a height that is known from elsewhere.
  void knowHeight(int surface, double height_m, double variance_m2);
  /// The surface is forgotten.
  void leave(int surface);
  /// A place for another surface: the one that was not seen for longest is forgotten.
  int makeRoom();
  /// The surface is below at this distance and its height follows from that, or its height is known from elsewhere.
  void meetUnknown(int surface, double distance_m, double variance_m2);
  void meetKnown(int surface, double height_m, double height_variance_m2);

  void beginSlope(int surface, const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& gradient, double variance);
  void endSlope(const Eigen::Vector2d& place_map_m);

 private:
  static constexpr int kHeight = 0, kVelocity = 1, kBias = 2, kGradient = 3, kFirst = 5, kSize = kFirst + kSurfaces;
  using State = Eigen::Matrix<double, kSize, 1>;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;
  using Row = Eigen::Matrix<double, 1, kSize>;

  static int at(int surface) { return kFirst + surface; }
  Row row(int surface, const Eigen::Vector2d& place_map_m) const;
  Innovation innovationOf(const Row& row, double value, double variance) const;
  void update(const Row& row, double value, double variance);
  void forget(int component);
  void forgetGradient();

  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace swiftlet::perception::altitude
