#include "common/small_matrices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swiftlet::common {
namespace {

TEST(SymmetricEigen, ValuesAscendAndVectorsMatchThem) {
  Eigen::Matrix3d matrix;
  matrix << 4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 1.0;
  const SymmetricEigen<3> eigen = symmetricEigen(matrix);
  EXPECT_LT(eigen.values(0), eigen.values(1));
  EXPECT_LT(eigen.values(1), eigen.values(2));
  EXPECT_TRUE((matrix * eigen.vectors).isApprox(eigen.vectors * eigen.values.asDiagonal(), 1e-12));
  EXPECT_TRUE((eigen.vectors.transpose() * eigen.vectors).isIdentity(1e-12));
}

// Both functions return identical values, so that a flight does not depend on which one is called.
TEST(SymmetricEigen, ValuesAloneAreIdenticalToValuesWithVectors) {
  const Eigen::Matrix2d two{{2.0, -0.7}, {-0.7, 0.3}};
  EXPECT_EQ(symmetricEigenvalues(two), symmetricEigen(two).values);
  const Eigen::Matrix3d three{{2.0, -0.7, 0.1}, {-0.7, 0.3, 0.2}, {0.1, 0.2, 5.0}};
  EXPECT_EQ(symmetricEigenvalues(three), symmetricEigen(three).values);
}

TEST(SymmetricEigen, NanGivesNanEigenvalues) {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
  matrix(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(symmetricEigenvalues(matrix).allFinite());
}

TEST(GeneralizedEigenvalues, AreTheRatiosAlongCommonDirections) {
  const Eigen::Matrix2d matrix = Eigen::Vector2d(3.0, 8.0).asDiagonal();
  const Eigen::Matrix2d other = Eigen::Vector2d(6.0, 4.0).asDiagonal();
  EXPECT_TRUE(generalizedEigenvalues(matrix, other).isApprox(Eigen::Vector2d(0.5, 2.0), 1e-12));
}

TEST(LeastNormSolution, IsTheShortestLeastSquaresSolution) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -2.0).normalized();
  const Eigen::Matrix3d onto_axis = axis * axis.transpose();
  const Eigen::Vector3d right(0.3, -1.0, 2.0);
  EXPECT_TRUE(leastNormSolution(onto_axis, right).isApprox(axis * axis.dot(right), 1e-12));
  EXPECT_TRUE(leastNormSolution(Eigen::Matrix3d::Zero(), right).isZero());
}

}  // namespace
}  // namespace swiftlet::common
