#include "perception/altitude/ground_hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "common/square.hpp"
#include "perception/fusion/fusion_config.hpp"

namespace swiftlet::perception::altitude {

using common::square;

namespace {

/// Random walk of the accelerometer's bias while it jumps: by 1.0 m/s2 within a second
/// (docs/decisions/altitude.md#112).
constexpr double kRestlessWalk_m_s3_rthz = 1.0;

}  // namespace

GroundHypothesis::GroundHypothesis(const VerticalState& state, common::Time now, int serial) {
  assume(state);
  surfaces[0] = {.serial = serial, .level = kFloor, .first = now, .last = now, .scans = 1};
}

VerticalState GroundHypothesis::vertical() const {
  return {state_[kHeight], state_[kVelocity], state_[kBias], covariance_.topLeftCorner<3, 3>()};
}

void GroundHypothesis::assume(const VerticalState& state) {
  const double moved_m = state.height_m - state_[kHeight];
  state_.head<3>() << state.height_m, state.velocity_m_s, state.bias_m_s2;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  covariance_.topLeftCorner<3, 3>() = state.covariance;
  for (int i = 0; i < kSurfaces; ++i)
    if (surfaces[static_cast<std::size_t>(i)].level == kNoLevel) state_[at(i)] += moved_m;
}

int GroundHypothesis::slopingSurface() const {
  for (int i = 0; i < kSurfaces; ++i)
    if (surfaces[static_cast<std::size_t>(i)].slopes) return i;
  return -1;
}

void GroundHypothesis::predict(double dt_s, const InertialClimb& climb, bool at_rest) {
  Covariance f = Covariance::Identity();
  f(kHeight, kVelocity) = dt_s;
  f(kHeight, kBias) = -0.5 * square(dt_s);
  f(kVelocity, kBias) = -dt_s;
  state_ = f * state_;
  state_[kHeight] += climb.height_m;
  state_[kVelocity] += climb.velocity_m_s;
  covariance_ = f * covariance_ * f.transpose();
  const double noise = square(climb.noise_m_s2_rthz) * dt_s;
  covariance_(kVelocity, kVelocity) += noise;
  covariance_(kHeight, kHeight) += noise * square(dt_s) / 3.0;
  covariance_(kHeight, kVelocity) += 0.5 * noise * dt_s;
  covariance_(kVelocity, kHeight) += 0.5 * noise * dt_s;
  covariance_(kBias, kBias) +=
      square(restless ? kRestlessWalk_m_s3_rthz : FusionConfig().accelerometer_bias_walk_m_s3_rthz) * dt_s;
  if (at_rest) update(Row::Unit(kVelocity), 0.0, square(FusionConfig::zero_velocity_sigma_m_s));
}

double GroundHypothesis::Innovation::logDensity() const {
  return -0.5 * (squaredMahalanobis() + std::log(2.0 * std::numbers::pi * variance));
}

GroundHypothesis::Row GroundHypothesis::row(int surface, const Eigen::Vector2d& place_map_m) const {
  const Surface& below = surfaces[static_cast<std::size_t>(surface)];
  Row row = Row::Unit(kHeight) - Row::Unit(at(surface));
  if (below.slopes) row.segment<2>(kGradient) = -(place_map_m - below.sloped_from_map_m).transpose();
  return row;
}

GroundHypothesis::Innovation GroundHypothesis::innovationOf(const Row& row, double value, double variance) const {
  return {value - row * state_, variance + row * covariance_ * row.transpose()};
}

GroundHypothesis::Innovation GroundHypothesis::innovation(int surface, const Eigen::Vector2d& place_map_m,
                                                          double distance_m, double variance_m2) const {
  return innovationOf(row(surface, place_map_m), distance_m, variance_m2);
}

GroundHypothesis::Innovation GroundHypothesis::innovationOver(double height_m, double distance_m,
                                                              double variance_m2) const {
  return innovationOf(Row::Unit(kHeight), height_m + distance_m, variance_m2);
}

GroundHypothesis::Innovation GroundHypothesis::innovationOfHeight(int surface, double height_m,
                                                                  double variance_m2) const {
  return innovationOf(Row::Unit(at(surface)), height_m, variance_m2);
}

void GroundHypothesis::update(const Row& row, double value, double variance) {
  const State cross = covariance_ * row.transpose();
  const double innovation_variance = row * cross + variance;
  const State gain = cross / innovation_variance;
  state_ += gain * (value - row * state_);
  covariance_ -= gain * cross.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

void GroundHypothesis::measure(int surface, const Eigen::Vector2d& place_map_m, double distance_m, double variance_m2) {
  update(row(surface, place_map_m), distance_m, variance_m2);
}

void GroundHypothesis::knowHeight(int surface, double height_m, double variance_m2) {
  update(Row::Unit(at(surface)), height_m, variance_m2);
}

void GroundHypothesis::forget(int component) {
  state_[component] = 0.0;
  covariance_.row(component).setZero();
  covariance_.col(component).setZero();
}

void GroundHypothesis::forgetGradient() {
  forget(kGradient);
  forget(kGradient + 1);
}

void GroundHypothesis::leave(int surface) {
  Surface& left = surfaces[static_cast<std::size_t>(surface)];
  if (left.slopes) forgetGradient();
  left = {};
  forget(at(surface));
}

int GroundHypothesis::makeRoom() {
  const auto oldest = std::min_element(surfaces.begin(), surfaces.end(), [](const Surface& a, const Surface& b) {
    return a.serial == 0 ? b.serial != 0 : b.serial != 0 && a.last < b.last;
  });
  const int index = static_cast<int>(oldest - surfaces.begin());
  leave(index);
  return index;
}

void GroundHypothesis::meetUnknown(int surface, double distance_m, double variance_m2) {
  state_[at(surface)] = state_[kHeight] - distance_m;
  covariance_.row(at(surface)) = covariance_.row(kHeight);
  covariance_.col(at(surface)) = covariance_.col(kHeight);
  covariance_(at(surface), at(surface)) = covariance_(kHeight, kHeight) + variance_m2;
}

void GroundHypothesis::meetKnown(int surface, double height_m, double height_variance_m2) {
  forget(at(surface));
  state_[at(surface)] = height_m;
  covariance_(at(surface), at(surface)) = height_variance_m2;
}

void GroundHypothesis::beginSlope(int surface, const Eigen::Vector2d& place_map_m, const Eigen::Vector2d& gradient,
                                  double variance) {
  Surface& below = surfaces[static_cast<std::size_t>(surface)];
  below.slopes = true;
  below.sloped_from_map_m = place_map_m;
  below.level = kNoLevel;
  state_.segment<2>(kGradient) = gradient;
  covariance_(kGradient, kGradient) = covariance_(kGradient + 1, kGradient + 1) = variance;
}

void GroundHypothesis::endSlope(const Eigen::Vector2d& place_map_m) {
  const int surface = slopingSurface();
  if (surface < 0) return;
  Surface& below = surfaces[static_cast<std::size_t>(surface)];
  Covariance moved = Covariance::Identity();
  moved.block<1, 2>(at(surface), kGradient) = (place_map_m - below.sloped_from_map_m).transpose();
  state_ = moved * state_;
  covariance_ = moved * covariance_ * moved.transpose();
  below.slopes = false;
  forgetGradient();
}

}  // namespace swiftlet::perception::altitude
