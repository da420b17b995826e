#include "perception/altitude/prior_correction.hpp"

#include <cmath>

namespace swiftlet::perception::altitude {
namespace {

/// A prior that is no farther off has taken in a jump. Its height alone would pass by the right one.
constexpr double kAgreed_m = 0.05, kAgreed_m_s = 0.10;

}  // namespace

bool PriorCorrection::isTakenIn(const HeightState& prior, const HeightFilter& present) const {
  return jumps && std::abs(prior.height_m - present.height_m()) < kAgreed_m &&
         std::abs(prior.velocity_m_s - present.velocity_m_s()) < kAgreed_m_s;
}

HeightState PriorCorrection::applied(const HeightState& prior, const HeightFilter& present, common::Time now) const {
  const double since_s = (now - since).seconds();
  Eigen::Matrix2d moved;
  moved << 1.0, since_s, 0.0, 1.0;
  HeightState state{now, prior.height_m + height_m + velocity_m_s * since_s, prior.velocity_m_s + velocity_m_s,
                    moved * covariance * moved.transpose()};
  if (jumps) {
    state.velocity_m_s = present.velocity_m_s();
    state.height_m = present.height_m() + state.velocity_m_s * (now - present.stamp()).seconds();
  }
  return state;
}

}  // namespace swiftlet::perception::altitude
