// What the readers of .ply and .pcd share: a table of numbers with a point in each row.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/submap3d.hpp"

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

/// Throws InputError with the file, the place in it and the reason.
[[noreturn]] void fail(const std::string& name, std::size_t place, const std::string& message,
                       const std::string& hint = "");

/// Reads a file from its beginning.
class Cursor {
 public:
  Cursor(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::size_t place() const { return place_; }
  std::size_t left() const { return bytes_.size() - place_; }
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const {
    point_table::fail(name_, place_, message, hint);
  }
  /// The next line of a header, without its end. Throws InputError at the end of the file or if it is too long.
  std::string_view line();
  /// Throws InputError if fewer are left.
  std::string_view take(std::size_t count);
  /// The next number in text, between blanks and line ends. Throws InputError if there is none.
  double number();

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t place_ = 0;
};

/// The value of a binary number; `swapped` if its bytes are in the other order than this machine's.
double valueOf(const char* bytes, Scalar type, bool swapped);

/// A whole number from a header. Throws InputError through the cursor.
std::size_t count(const Cursor& cursor, std::string_view text);

std::vector<std::string_view> words(std::string_view line);

/// Makes points from rows: set() for each column, then finish().
class Builder {
 public:
  void set(const Column& column, double value);
  void finish();
  std::vector<common::SurfacePoint> take() { return std::move(points_); }

 private:
  static common::SurfacePoint blank();

  std::vector<common::SurfacePoint> points_;
  common::SurfacePoint next_ = blank();
};

}  // namespace swiftlet::interfaces::point_table
