#include "optimization/bundle_adjustment.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "optimization/ceres_solver.hpp"

namespace swiftlet::optimization {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

/// U with U' * U = information.
template <typename Matrix>
Matrix rootOf(const Matrix& information) {
  return information.llt().matrixU();
}

/// A pose is (x, y, z, qx, qy, qz, qw).
template <typename T>
struct PoseBlock {
  explicit PoseBlock(const T* block) : position(block), rotation(block + 3) {}
  Eigen::Map<const Vector3<T>> position;
  Eigen::Map<const Eigen::Quaternion<T>> rotation;
};

/// Of a landmark, in the axes of the pose that sees it.
class PointError {
 public:
  explicit PointError(const PointObservation& seen)
      : point_m_(seen.point_m), root_(rootOf(Eigen::Matrix3d(seen.covariance_m2.inverse()))) {}

  template <typename T>
  bool operator()(const T* pose, const T* landmark, T* residuals) const {
    const PoseBlock<T> at(pose);
    const Vector3<T> difference = Eigen::Map<const Vector3<T>>(landmark) - at.position;
    const Vector3<T> error = at.rotation.conjugate() * difference - point_m_.cast<T>();
    Eigen::Map<Vector3<T>> whitened(residuals);
    whitened = root_.cast<T>() * error;
    return true;
  }

 private:
  Eigen::Vector3d point_m_;
  Eigen::Matrix3d root_;
};

/// Rotations are compared by twice the vector of the quaternion between them, which is the rotation vector to second
/// order.
class PoseError {
 public:
  explicit PoseError(const MeasuredPose3D& measured)
      : T_map_(measured.T_map_measured), root_(rootOf(measured.information)) {}

  template <typename T>
  bool operator()(const T* pose, T* residuals) const {
    const PoseBlock<T> at(pose);
    const Eigen::Quaternion<T> inverse = T_map_.rotation.conjugate().cast<T>();
    const Vector3<T> difference = at.position - T_map_.position_m.cast<T>();
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = inverse * difference;
    const Eigen::Quaternion<T> turn = inverse * at.rotation;
    error.template tail<3>() = (turn.w() < T(0.0) ? T(-2.0) : T(2.0)) * turn.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> whitened(residuals);
    whitened = root_.cast<T>() * error;
    return true;
  }

 private:
  common::Pose3 T_map_;
  Matrix6d root_;
};

Vector7d blockOf(const common::Pose3& pose) {
  Vector7d block;
  block << pose.position_m, pose.rotation.coeffs();
  return block;
}

std::size_t indexOf(int index) { return static_cast<std::size_t>(index); }

}  // namespace

double squaredError(const Bundle& bundle) {
  double sum = 0.0;
  Eigen::Vector3d point_error;
  for (const PointObservation& seen : bundle.observations) {
    PointError{seen}(blockOf(bundle.poses[indexOf(seen.pose)]).data(),
                     bundle.landmarks_m[indexOf(seen.landmark)].data(), point_error.data());
    sum += point_error.squaredNorm();
  }
  Vector6d pose_error;
  for (const MeasuredPose3D& measured : bundle.measured) {
    PoseError{measured}(blockOf(bundle.poses[indexOf(measured.pose)]).data(), pose_error.data());
    sum += pose_error.squaredNorm();
  }
  return sum;
}

void adjust(Bundle& bundle, const PoseGraphConfig& config) {
  if (bundle.observations.empty()) return;
  auto* manifold = new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>;
  ceres::Problem problem;
  std::vector<Vector7d> poses;
  poses.reserve(bundle.poses.size());
  for (const common::Pose3& pose : bundle.poses) {
    poses.push_back(blockOf(pose));
    problem.AddParameterBlock(poses.back().data(), 7, manifold);
  }
  for (const int fixed : bundle.fixed) problem.SetParameterBlockConstant(poses[indexOf(fixed)].data());
  std::vector<Eigen::Vector3d> landmarks_m = bundle.landmarks_m;
  for (const PointObservation& seen : bundle.observations)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PointError, 3, 7, 3>(new PointError(seen)),
                             new ceres::CauchyLoss(config.robust_width), poses[indexOf(seen.pose)].data(),
                             landmarks_m[indexOf(seen.landmark)].data());
  for (const MeasuredPose3D& measured : bundle.measured)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PoseError, 6, 7>(new PoseError(measured)), nullptr,
                             poses[indexOf(measured.pose)].data());
  if (!solve(problem, config).IsSolutionUsable()) return;
  bundle.landmarks_m = std::move(landmarks_m);
  for (std::size_t i = 0; i < poses.size(); ++i)
    bundle.poses[i] = {Eigen::Quaterniond(poses[i].tail<4>()).normalized(), poses[i].head<3>()};
}

}  // namespace swiftlet::optimization
