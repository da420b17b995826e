#include "perception/altitude/prior_correction.hpp"

#include <cmath>

namespace swiftlet::perception::altitude {
namespace {

/// A prior that is no farther off has taken in a regained floor. Its height alone would pass by the right one.
constexpr double kAgreed_m = 0.05, kAgreed_m_s = 0.10;

bool agree(const HeightState& prior, const HeightFilter& present) {
  return std::abs(prior.height_m - present.height_m()) < kAgreed_m &&
         std::abs(prior.velocity_m_s - present.velocity_m_s()) < kAgreed_m_s;
}

Eigen::Matrix2d moved(const Eigen::Matrix2d& covariance, double time_s) {
  Eigen::Matrix2d motion;
  motion << 1.0, time_s, 0.0, 1.0;
  return motion * covariance * motion.transpose();
}

}  // namespace

std::optional<double> PriorCorrection::speedVariance_m2_s2() const {
  if (regained_) return regained_->covariance(1, 1);
  return entered_ ? std::optional(entered_->covariance(1, 1)) : std::nullopt;
}

HeightState PriorCorrection::applied(const HeightState& prior, const HeightFilter& present) {
  if (regained_ && agree(prior, present)) regained_.reset();
  HeightState state = prior;
  if (regained_) {
    state.velocity_m_s = present.velocity_m_s();
    state.height_m = present.height_m() + state.velocity_m_s * (prior.stamp - present.stamp()).seconds();
    state.covariance = moved(regained_->covariance, (prior.stamp - regained_->since).seconds());
  } else if (entered_) {
    const double since_s = (prior.stamp - entered_->since).seconds();
    state.height_m = prior.height_m + entered_->height_m + entered_->velocity_m_s * since_s;
    state.velocity_m_s = prior.velocity_m_s + entered_->velocity_m_s;
    state.covariance = moved(entered_->covariance, since_s);
  }
  return state;
}

}  // namespace swiftlet::perception::altitude
