// Entries of the inverse of a sparse symmetric positive definite matrix, only where its Cholesky factor has entries
// (Takahashi, Fagan and Chin 1973). Whatever is in the pattern of the matrix is among them.
#pragma once

#include <vector>

#include <Eigen/SparseCholesky>

namespace swiftlet::optimization {

class SelectedInverse {
 public:
  /// From the entries of the lower triangle; those of one place are added up, zeros count as places. False where the
  /// matrix is not positive definite. The structure is analysed when the number of rows changes.
  bool compute(int rows, const std::vector<Eigen::Triplet<double>>& lower);

  /// Of a place in the pattern of the matrix or its transpose.
  double operator()(int row, int column) const;

 private:
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::SparseMatrix<double> inverse_;  ///< Lower triangle, in the order of the factor.
  Eigen::Index analysed_rows_ = -1;
};

}  // namespace swiftlet::optimization
