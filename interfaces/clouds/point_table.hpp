// What the readers of .ply and .pcd share: a table of numbers with a point in each row.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/message.hpp"
#include "interfaces/clouds/point_colors.hpp"
#include "interfaces/clouds/stored_cloud.hpp"

namespace swiftlet::interfaces::point_table {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble, kInt64, kUint64 };

std::size_t bytesOf(Scalar type);

/// What a column is for.
enum class Role { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kRed, kGreen, kBlue, kPackedRgb, kOther };

struct Column {
  Role role = Role::kOther;
  Scalar type = Scalar::kFloat;

  /// The column in a binary file. Packed colours are bits there, whatever their type says: some are no numbers as a
  /// float, and a conversion would change them.
  Column inBinary() const {
    return {role, role == Role::kPackedRgb && type == Scalar::kFloat ? Scalar::kUint32 : type};
  }
};

/// Reads a file from its beginning: first as text, from the first take() on as binary.
class Cursor {
 public:
  /// A byte order mark, which some editors put before text, is skipped.
  Cursor(std::string_view bytes, const std::string& name);

  std::size_t place() const { return place_; }
  std::size_t left() const { return bytes_.size() - place_; }
  /// Throws InputError with the file, the line in text or the byte in binary, and the reason.
  [[noreturn]] void fail(common::Message message, std::string hint = "") const;
  /// Of what was read last, in text; from 1.
  int lineNumber() const;
  /// The next line of a header, without its end. Throws InputError at the end of the file or if it is too long.
  std::string_view line();
  /// Throws InputError if fewer are left.
  std::string_view take(std::size_t count);
  /// How many lines that are not blank are left in text.
  std::size_t rowsLeft() const;
  /// Goes to the next line in text that is not blank. A row begins there.
  void beginRow();
  /// The next number in text, between blanks. Throws InputError if the line has none.
  double number();
  /// Goes behind the end of the line. Throws InputError if more numbers come before it.
  void endRow();

 private:
  void skipBlanks();
  /// The first characters of the word that begins here, for messages.
  std::string word() const;

  std::string_view bytes_;
  const std::string& name_;
  std::size_t place_ = 0;
  std::size_t word_place_ = 0;  ///< Begin of what was read last, in text.
  bool text_ = true;
};

/// The value of a binary number; `swapped` if its bytes are in the other order than this machine's.
double valueOf(const char* bytes, Scalar type, bool swapped);

/// A whole number from a header. Throws InputError through the cursor.
std::size_t count(const Cursor& cursor, std::string_view text);

std::vector<std::string_view> words(std::string_view line);

/// Of all columns of a file, by the names that tools give to them: "x", "nx", "normal_x", "red", "diffuse_red", "rgb"
/// ..., in any case. Each role has one column at most: a name in small letters counts before one in capitals, then the
/// more usual name. Red, green and blue come together. Throws InputError through the cursor without x, y and z.
std::vector<Role> rolesOf(const Cursor& cursor, const std::vector<std::string_view>& names);

/// "columns left out: ring, time" for those of kOther, without padding; empty without one.
std::string leftOutColumns(const std::vector<std::string_view>& names, const std::vector<Role>& roles);

/// Makes points from rows: set() for each column, then finish(). A point whose position is not finite is left out.
class Builder {
 public:
  explicit Builder(const CloudPlacement& placement) : placement_(placement) { next_.rgb = common::kUnknownColor; }

  void set(const Column& column, double value);
  void finish();
  /// Takes the unit that a comment of the header names, if it is the first that does.
  void comment(const Cursor& cursor, std::string_view text);
  /// Empty notes are ignored.
  void note(const std::string& text);
  /// Notes how many points the file has behind those that its header promises.
  void noteSurplus(std::size_t surplus, std::size_t promised);
  StoredCloud take();

 private:
  void place();
  /// False if the value is no colour.
  bool setPackedColor(double value, Scalar type);

  CloudPlacement placement_;
  StoredCloud cloud_;
  std::vector<RawColor> colors_;  ///< Of each point, if the file has columns of red, green and blue.
  std::optional<ColorType> color_type_;
  std::size_t no_colors_ = 0;  ///< Points with a position, and with something else than a colour in its column.
  bool is_color_missing_ = false;

  Eigen::Vector3d position_file_ = Eigen::Vector3d::Zero();
  RawColor color_{};
  common::SurfacePoint next_;
};

}  // namespace swiftlet::interfaces::point_table
