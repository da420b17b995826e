#include "common/small_matrices.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace swiftlet::common {
namespace {

template <int kSize>
using Square = Eigen::Matrix<double, kSize, kSize>;

template <int kSize>
Eigen::SelfAdjointEigenSolver<Square<kSize>> solved(const Square<kSize>& matrix, int what) {
  return Eigen::SelfAdjointEigenSolver<Square<kSize>>(matrix, what);
}

template <int kSize>
SymmetricEigen<kSize> eigenOf(const Square<kSize>& matrix) {
  const auto eigen = solved<kSize>(matrix, Eigen::ComputeEigenvectors);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace

SymmetricEigen<2> symmetricEigen(const Eigen::Matrix2d& matrix) { return eigenOf<2>(matrix); }
SymmetricEigen<3> symmetricEigen(const Eigen::Matrix3d& matrix) { return eigenOf<3>(matrix); }

Eigen::Vector2d symmetricEigenvalues(const Eigen::Matrix2d& matrix) {
  return solved<2>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Vector3d symmetricEigenvalues(const Eigen::Matrix3d& matrix) {
  return solved<3>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Vector2d generalizedEigenvalues(const Eigen::Matrix2d& matrix, const Eigen::Matrix2d& other) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(matrix, other, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Vector3d leastNormSolution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right) {
  return matrix.completeOrthogonalDecomposition().solve(right);
}

}  // namespace swiftlet::common
