// The words of a line of a g2o file, for its reader.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/geometry.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {

/// Reads words from the left, after the tag. Throws InputError if a word is not of the expected kind. A word must be
/// left: call expectNumbers first.
class G2oFields {
 public:
  /// At least one word, the tag. `lines` and the line must outlive this.
  G2oFields(const LineReader& lines, std::vector<Word> words) : lines_(lines), words_(std::move(words)) {}

  std::string tag() const { return std::string(words_[0].text); }
  std::size_t left() const { return words_.size() - next_; }
  /// Column of the next word, or of the last one at the end.
  int column() const { return words_[std::min(next_, words_.size() - 1)].column; }

  void expectNumbers(std::size_t count) const;
  /// For an edge: `begin` numbers, then those of its information. `hint` says how that is written.
  void expectInformation(std::size_t begin, std::size_t numbers, const char* hint) const;
  std::int64_t id();
  double number(const char* name);
  /// A length within kFarthest_m.
  double coordinate_m(const char* name);
  common::Pose2 pose2();
  common::Pose3 pose3();
  /// x, y, z, roll, pitch, yaw.
  common::Pose3 pose3OfAngles();
  /// The upper triangle, row by row, without a check of its values.
  template <typename Matrix>
  Matrix information();
  /// The order of TORO in the plane: xx xy yy, yaw yaw, x yaw, y yaw.
  Eigen::Matrix3d toroInformation();

  common::InputError problem(int column, common::Message message, const std::string& hint = "") const {
    return lines_.problemAt(column, tag(), std::move(message), hint);
  }

 private:
  /// Of one number of the element.
  common::InputError problem(int column, const char* number, common::Message message,
                             const std::string& hint = "") const {
    return lines_.problemAt(column, tag() + ": " + number, std::move(message), hint);
  }

  const LineReader& lines_;
  std::vector<Word> words_;
  std::size_t next_ = 1;
};

template <typename Matrix>
Matrix G2oFields::information() {
  Matrix matrix;
  for (int row = 0; row < Matrix::RowsAtCompileTime; ++row)
    for (int col = row; col < Matrix::ColsAtCompileTime; ++col)
      matrix(row, col) = matrix(col, row) = number("information");
  return matrix;
}

}  // namespace swiftlet::interfaces
