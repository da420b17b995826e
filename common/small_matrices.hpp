// Decompositions of 2x2 and 3x3 matrices. They are Eigen's; a source that names one of its solvers takes seconds longer
// to compile, so they are compiled once, here. Pure functions.
#pragma once

#include <Eigen/Core>

namespace swiftlet::common {

/// Of a symmetric matrix, of which the lower triangle is read.
template <int kSize>
struct SymmetricEigen {
  Eigen::Matrix<double, kSize, 1> values;       ///< Ascending.
  Eigen::Matrix<double, kSize, kSize> vectors;  ///< Its columns, of unit length, in the order of the values.
};

/// NaN or infinity in the matrix gives NaN.
SymmetricEigen<2> symmetricEigen(const Eigen::Matrix2d& matrix);
SymmetricEigen<3> symmetricEigen(const Eigen::Matrix3d& matrix);

/// The values alone.
Eigen::Vector2d symmetricEigenvalues(const Eigen::Matrix2d& matrix);
Eigen::Vector3d symmetricEigenvalues(const Eigen::Matrix3d& matrix);

/// Ascending, of matrix * v = value * other * v; both symmetric, `other` positive definite.
Eigen::Vector2d generalizedEigenvalues(const Eigen::Matrix2d& matrix, const Eigen::Matrix2d& other);

/// Of all x for which |matrix * x - right| is least, the shortest.
Eigen::Vector3d leastNormSolution(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

}  // namespace swiftlet::common
