#include "interfaces/files/pose_matrices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "common/lower_case.hpp"
#include "interfaces/files/line_fields.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;
using Rows = std::array<double, 16>;

/// Files have four digits or more; only a rotation is this near to one.
constexpr double kRotationWithin = 0.02;
constexpr double kLastRowWithin = 1e-3;
constexpr double kGreatestFrame = 1e9;

/// Numbers of one matrix so far, and the column of the first where they are in one line.
class Matrix {
 public:
  std::size_t size() const { return size_; }

  /// The words from `first` on. Throws InputError for one that is no number.
  void add(const LineReader& reader, const std::vector<Word>& words, std::size_t first) {
    if (words.size() > 4) column_ = words[first].column;
    for (std::size_t i = first; i < words.size(); ++i) {
      double value = 0.0;
      if (parseNumber(words[i].text, value)) {
        // A coordinate.
        if (size_ % 4 == 3 && std::abs(value) > kFarthest_m)
          throw reader.problemAt(words[i].column, "pose",
                                 Message("text.too-far", "is farther away than {} m", kFarthest_m));
        ++finite_;
      } else if (!isNotFinite(words[i].text)) {
        throw reader.problemAt(words[i].column, "pose",
                               Message("text.not-a-number", "`{}` is not a number", words[i].text), commaHint(words));
      }
      rows_[size_++] = value;
    }
  }

  /// nullopt if none of its numbers is finite. Throws InputError if it is no pose.
  std::optional<common::Pose3> pose(const LineReader& reader) const {
    const std::size_t upper = size_ == 16 && finite_ == 1 ? 1 : 0;  // The 1 of the last row may be there nevertheless.
    if (finite_ == upper) return std::nullopt;
    const auto refuse = [&](Message message, const char* hint) {
      throw reader.problemAt(column_, "pose", std::move(message), hint);
    };
    if (finite_ < size_) refuse(Message("matrix.not-finite", "some numbers of the matrix are not finite"), "");
    Eigen::Matrix<double, 3, 4> T;
    for (int i = 0; i < 12; ++i) T(i / 4, i % 4) = rows_[static_cast<std::size_t>(i)];
    if (size_ == 16) {
      const Eigen::Vector4d last(rows_[12], rows_[13], rows_[14], rows_[15]);
      const bool is_pose = (last - Eigen::Vector4d::UnitW()).cwiseAbs().maxCoeff() <= kLastRowWithin;
      if (!is_pose && areStampedPositions())
        refuse(Message("matrix.positions", "this looks like lines `t x y z`, without orientations"),
               "expected `t x y z qx qy qz qw` (TUM)");
      if (!is_pose)
        refuse(Message("matrix.last-row", "the last row of the matrix is not `0 0 0 1`"),
               "is it transposed? The position is the last column");
    }
    const Eigen::Matrix3d R = T.leftCols<3>();
    const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off < kRotationWithin))
      refuse(Message("matrix.no-rotation", "its first three columns are no rotation"), "scale and shear are not poses");
    if (R.determinant() < 0.0)
      refuse(Message("matrix.reflection", "its first three columns are a reflection"),
             "turn the axis that is mirrored");
    return common::Pose3{Eigen::Quaterniond(R).normalized(), T.col(3)};
  }

 private:
  /// Whether the four rows are positions behind stamps, which increase. The last column of a matrix that is transposed
  /// is that of the identity.
  bool areStampedPositions() const {
    const bool is_transposed = rows_[3] == 0.0 && rows_[7] == 0.0 && rows_[11] == 0.0 && rows_[15] == 1.0;
    return column_ == 0 && !is_transposed && rows_[0] < rows_[4] && rows_[4] < rows_[8] && rows_[8] < rows_[12];
  }

  static bool isNotFinite(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    const std::string text = common::lowerCase(word);
    return text == "inf" || text == "infinity" || text == "nan";
  }

  Rows rows_{};
  std::size_t size_ = 0, finite_ = 0;
  int column_ = 0;
};

/// A whole number, not negative.
double frameOf(const LineReader& reader, const Word& word) {
  double number = 0.0;
  if (parseNumber(word.text, number) && number >= 0.0 && number <= kGreatestFrame && number == std::floor(number))
    return number;
  throw reader.problemAt(word.column, "frame",
                         Message("matrix.no-frame-number", "`{}` is not the number of a frame", word.text));
}

Message numberCount(const std::vector<Word>& words, std::size_t expected) {
  return Message("text.number-count", "{} numbers instead of {}", words.size(), expected);
}

void addTo(RecordedPoses& found, const LineReader& reader, const Matrix& matrix, double frame) {
  if (const auto pose = matrix.pose(reader))
    found.poses.push_back({common::Time::fromSeconds(frame), *pose});
  else
    ++found.without_pose;
}

/// One matrix a line, of which the first `numbered` words are its frame's number.
void readRows(LineReader& reader, std::vector<Word>& words, RecordedPoses& found) {
  const std::size_t expected = words.size(), numbered = expected % 4;
  found.order = numbered == 1 ? PoseOrder::kNumbers : PoseOrder::kLines;
  double line = 0.0;
  do {
    if (words.size() != expected)
      throw reader.problemAt(words.back().column, "pose", numberCount(words, expected),
                             "a line is a matrix, row after row");
    Matrix matrix;
    matrix.add(reader, words, numbered);
    addTo(found, reader, matrix, numbered == 1 ? frameOf(reader, words[0]) : line++);
  } while (nextWords(reader, words));
}

/// Four lines a matrix; Open3D's have a line of three numbers before them.
void readBlocks(LineReader& reader, std::vector<Word>& words, RecordedPoses& found) {
  const bool headed = words.size() == 3;
  found.order = headed ? PoseOrder::kNumbers : PoseOrder::kLines;
  double frame = 0.0;
  bool more = true;
  while (more) {
    if (headed) {
      if (words.size() != 3)
        throw reader.problemAt(words.back().column, "frame", numberCount(words, 3),
                               "before each matrix stands a line `frame frame next`");
      frame = frameOf(reader, words[0]);
      if (frameOf(reader, words[1]) != frame)
        throw reader.problemAt(words[1].column, "frame", Message("matrix.other-frame", "is not the first number again"),
                               "this is a relation between two pieces, not a pose of a trajectory");
      more = nextWords(reader, words);
    }
    Matrix matrix;
    for (; more && matrix.size() < 16; more = nextWords(reader, words)) {
      if (words.size() != 4)
        throw reader.problemAt(words.back().column, "pose", numberCount(words, 4),
                               "a matrix has four rows of four numbers");
      matrix.add(reader, words, 0);
      if (matrix.size() == 16) addTo(found, reader, matrix, headed ? frame : frame++);
    }
    if (matrix.size() < 16)
      throw reader.problemAt(0, "pose",
                             Message("matrix.cut", "the matrix was cut after {} of its four rows", matrix.size() / 4));
  }
}

RecordedPoses readMatrices(LineReader reader) {
  RecordedPoses found;
  std::vector<Word> words;
  if (!nextWords(reader, words)) throw reader.problemAt(0, "", Message("poses.none", "holds no poses"));
  if (!areMatrices(words))
    throw reader.problemAt(words.back().column, "pose", Message("poses.other-count", "{} numbers", words.size()),
                           "expected a matrix: 12 or 16 numbers in a line, or four lines of 4");
  if (words.size() <= 4)
    readBlocks(reader, words, found);
  else
    readRows(reader, words, found);
  return found;
}

}  // namespace

bool areMatrices(const std::vector<Word>& words) {
  const auto isWhole = [](const Word& word) {
    double number = 0.0;
    return parseNumber(word.text, number) && number == std::floor(number);
  };
  if (words.size() == 3) return std::all_of(words.begin(), words.end(), isWhole);
  constexpr std::array<std::size_t, 5> kWords{4, 12, 13, 16, 17};
  return std::find(kWords.begin(), kWords.end(), words.size()) != kWords.end();
}

RecordedPoses readPoseMatrices(const std::filesystem::path& file) { return readMatrices(LineReader(file)); }

RecordedPoses parsePoseMatrices(std::string_view text, const std::string& name) {
  return readMatrices(LineReader::fromBytes(text, name));
}

void requireFinitePoses(const RecordedPoses& found, const std::filesystem::path& path) {
  if (!found.poses.empty()) return;
  throw common::InputError({path.string()}, "",
                           Message("poses.none-finite", "holds no poses: not one of its matrices is finite"));
}

}  // namespace swiftlet::interfaces
