#include "control/riccati.hpp"

namespace swiftlet::control {

LqrGains lqrGains(const AxisMatrix& A, const AxisVector& B, const AxisMatrix& Q, double r) {
  constexpr int kMostSteps = 20'000;  // 200 s at 100 Hz: far beyond the slowest mode that flies.
  constexpr double kSettled = 1e-10;  // Change of the gains, of the greatest of them: rounding, for all that flies.
  LqrGains gains;
  AxisMatrix P = Q;
  for (int step = 0; step < kMostSteps && !gains.converged; ++step) {
    const Eigen::RowVector4d BtP = B.transpose() * P;
    const Eigen::RowVector4d K = BtP * A / (r + BtP.dot(B.transpose()));
    P = Q + A.transpose() * P * (A - B * K);
    P = 0.5 * (P + P.transpose()).eval();
    gains.converged = step > 10 && (K - gains.K).cwiseAbs().maxCoeff() < kSettled * K.cwiseAbs().maxCoeff();
    gains.K = K;
  }
  return gains;
}

}  // namespace swiftlet::control
