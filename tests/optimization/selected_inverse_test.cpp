// Entries of a sparse inverse, against the dense one.
#include "optimization/selected_inverse.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "common/random.hpp"

namespace swiftlet::optimization {
namespace {

TEST(SelectedInverse, EqualsTheDenseInverseWhereTheMatrixHasAPlace) {
  common::RandomStream random(1, "selected");
  SelectedInverse inverse;
  for (int round = 0; round < 3; ++round) {  // The same structure, other numbers.
    const int size = 40;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    std::vector<Eigen::Triplet<double>> lower;
    const auto add = [&](int row, int column, double value) {
      lower.emplace_back(row, column, value);
      dense(row, column) += value;
      if (row != column) dense(column, row) += value;
    };
    for (int i = 0; i < size; ++i) add(i, i, 4.0 + random.uniform());
    for (int i = 1; i < size; ++i) add(i, i - 1, random.gaussian(0.5));
    for (int i = 9; i < size; i += 5) add(i, (i * i) % (i - 3), random.gaussian(0.5));
    add(30, 2, 0.0);  // A place without a value.
    ASSERT_TRUE(inverse.compute(size, lower));
    const Eigen::MatrixXd expected = dense.inverse();
    for (const auto& entry : lower) {
      EXPECT_NEAR(inverse(entry.row(), entry.col()), expected(entry.row(), entry.col()), 1e-12);
      EXPECT_EQ(inverse(entry.col(), entry.row()), inverse(entry.row(), entry.col()));
    }
  }
}

TEST(SelectedInverse, RefusesAMatrixThatIsNotPositiveDefinite) {
  SelectedInverse inverse;
  EXPECT_FALSE(inverse.compute(2, {{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}}));
}

}  // namespace
}  // namespace swiftlet::optimization
