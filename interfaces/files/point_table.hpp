// What the readers of .ply and .pcd share: a table of numbers with a point in each row.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "interfaces/files/stored_cloud.hpp"

namespace swiftlet::interfaces::point_table {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble, kInt64, kUint64 };

std::size_t bytesOf(Scalar type);

/// What a column is for.
enum class Role { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kRed, kGreen, kBlue, kPackedRgb, kOther };

/// By the names that tools give to columns: "x", "nx", "normal_x", "red", "diffuse_red", "rgb" ...
Role roleOf(std::string_view name);

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
  Cursor(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::size_t place() const { return place_; }
  std::size_t left() const { return bytes_.size() - place_; }
  /// Throws InputError with the file, the line in text or the byte in binary, and the reason.
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;
  /// The next line of a header, without its end. Throws InputError at the end of the file or if it is too long.
  std::string_view line();
  /// Throws InputError if fewer are left.
  std::string_view take(std::size_t count);
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

/// Makes points from rows: set() for each column, then finish(). A point whose position is not finite is left out.
class Builder {
 public:
  void set(const Column& column, double value);
  void finish();
  StoredCloud take() { return std::move(cloud_); }

 private:
  static common::SurfacePoint blank();

  StoredCloud cloud_;
  common::SurfacePoint next_ = blank();
};

}  // namespace swiftlet::interfaces::point_table
