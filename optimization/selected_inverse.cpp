#include "optimization/selected_inverse.hpp"

#include <algorithm>

namespace swiftlet::optimization {

bool SelectedInverse::compute(int rows, const std::vector<Eigen::Triplet<double>>& lower) {
  Eigen::SparseMatrix<double> matrix(rows, rows);
#ifndef __clang_analyzer__  // It takes the matrix for one without rows, inside Eigen.
  matrix.setFromTriplets(lower.begin(), lower.end());
#endif
  if (analysed_rows_ != rows) factor_.analyzePattern(matrix);
  analysed_rows_ = rows;
  factor_.factorize(matrix);
  if (factor_.info() != Eigen::Success) return false;

  // With Z = inverse of L L': Z L = inverse of L', which is upper triangular. Column j of Z below the diagonal is
  // -Z(rows, rows) * column j of L / L_jj, where `rows` are those of column j of L, from the columns to its right.
  const Eigen::SparseMatrix<double>& L = factor_.matrixL().nestedExpression();
  inverse_ = L;
  const int* begin = L.outerIndexPtr();
  const int* row = L.innerIndexPtr();
  const double* value = L.valuePtr();
  double* z = inverse_.valuePtr();
  int most = 0;
  for (int j = 0; j < rows; ++j) most = std::max(most, begin[j + 1] - begin[j]);
  // Z(rows, rows), the last row first: from one column of a block of poses to the next it only grows by one at its end.
  Eigen::MatrixXd block(most, most);
  for (int j = rows - 1; j >= 0; --j) {
    const int first = begin[j] + 1, end = begin[j + 1], size = end - first;
    const auto place = [&](int p) { return end - 1 - p; };
    const bool grows = size > 0 && row[first] == j + 1 && begin[j + 2] - begin[j + 1] == size;
    for (int p = grows ? first : end - 1; p >= first; --p) {
      const int k = row[p];
      block(place(p), place(p)) = z[begin[k]];
      for (int q = p + 1, r = begin[k] + 1; q < end; ++q) {
        while (row[r] != row[q]) ++r;
        block(place(p), place(q)) = block(place(q), place(p)) = z[r];
      }
    }
    const auto column = Eigen::Map<const Eigen::VectorXd>(value + first, size);
    Eigen::Map<Eigen::VectorXd> below(z + first, size);
    below = (block.topLeftCorner(size, size) * column.reverse()).reverse() / -value[begin[j]];
    z[begin[j]] = (1.0 / value[begin[j]] - below.dot(column)) / value[begin[j]];
  }
  return true;
}

double SelectedInverse::operator()(int row, int column) const {
  const auto& order = factor_.permutationP().indices();
  const int i = std::max(order[row], order[column]), j = std::min(order[row], order[column]);
  const int* begin = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[j];
  const int* end = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[j + 1];
  return inverse_.valuePtr()[std::lower_bound(begin, end, i) - inverse_.innerIndexPtr()];
}

}  // namespace swiftlet::optimization
