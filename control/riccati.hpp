// The gains of a linear quadratic regulator in discrete time.
#pragma once

#include <Eigen/Core>

namespace swiftlet::control {

/// The integral of the position error, the position error, the velocity error and the acceleration that a lagging
/// vehicle has taken up.
using AxisMatrix = Eigen::Matrix4d;
using AxisVector = Eigen::Vector4d;

/// K that minimizes sum(x' Q x + r u^2) for x_next = A x + B u, u = -K x: the fixed point of the discrete Riccati
/// recursion. `converged` is false if it was not reached; K is then of the last step.
struct LqrGains {
  Eigen::RowVector4d K = Eigen::RowVector4d::Zero();
  bool converged = false;
};
LqrGains lqrGains(const AxisMatrix& A, const AxisVector& B, const AxisMatrix& Q, double r);

}  // namespace swiftlet::control
