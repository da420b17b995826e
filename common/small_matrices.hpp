// Decompositions of 2x2 and 3x3 matrices by Eigen. A source that uses one of Eigen's solvers takes seconds longer to
// compile, so they are compiled only once, here. Pure functions.
#pragma once

#include <Eigen/Core>

namespace swiftlet::common {

/// The eigenvalues and eigenvectors of a symmetric matrix.
template <int kSize>
struct SymmetricEigen {
  Eigen::Matrix<double, kSize, 1> values;       ///< Ascending.
  Eigen::Matrix<double, kSize, kSize> vectors;  ///< Unit columns, in the order of the values.
};

/// Reads only the lower triangle of the matrix. NaN or infinity in it gives NaN.
SymmetricEigen<2> symmetricEigen(const Eigen::Matrix2d& matrix);
SymmetricEigen<3> symmetricEigen(const Eigen::Matrix3d& matrix);

/// Only the eigenvalues, ascending. Reads only the lower triangle of the matrix.
Eigen::Vector2d symmetricEigenvalues(const Eigen::Matrix2d& matrix);
Eigen::Vector3d symmetricEigenvalues(const Eigen::Matrix3d& matrix);

/// The eigenvalues of matrix * v = value * other * v, ascending. Both are symmetric, and `other` is positive definite.
Eigen::Vector2d generalizedEigenvalues(const Eigen::Matrix2d& matrix, const Eigen::Matrix2d& other);

/// The least-squares solution of matrix * x = right; if there are several, the one with the smallest norm.
Eigen::Vector3d leastNormSolution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

}  // namespace swiftlet::common
