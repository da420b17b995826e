#include "interfaces/files/pcd_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "common/printable.hpp"
#include "interfaces/files/point_table.hpp"

namespace swiftlet::interfaces {
namespace {

using namespace point_table;

/// A field holds `count` numbers of one type, the first of which counts.
struct Field {
  Column column;
  std::size_t count = 1;
  std::size_t bytes() const { return count * bytesOf(column.type); }
};

struct PcdHeader {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::string_view data;  ///< "ascii", "binary" or "binary_compressed".

  std::size_t rowBytes() const {
    std::size_t sum = 0;
    for (const Field& field : fields) sum += field.bytes();
    return sum;
  }
};

Scalar pcdScalar(const Cursor& cursor, std::string_view type, std::size_t size) {
  if (type == "F" && size == 4) return Scalar::kFloat;
  if (type == "F" && size == 8) return Scalar::kDouble;
  if (type == "I" || type == "U") {
    const bool sign = type == "I";
    if (size == 1) return sign ? Scalar::kInt8 : Scalar::kUint8;
    if (size == 2) return sign ? Scalar::kInt16 : Scalar::kUint16;
    if (size == 4) return sign ? Scalar::kInt32 : Scalar::kUint32;
    if (size == 8) return sign ? Scalar::kInt64 : Scalar::kUint64;
  }
  cursor.fail(
      fmt::format("a field has the type `{}` with {} bytes", common::printable(std::string(type.substr(0, 8))), size));
}

/// The lines of the header by their first word, up to DATA.
class HeaderReader {
 public:
  explicit HeaderReader(Cursor& cursor) : cursor_(cursor) {}

  PcdHeader read() {
    PcdHeader header;
    while (header.data.empty()) {
      const std::vector<std::string_view> line = words(cursor_.line());
      if (line.empty() || line[0].starts_with('#')) continue;
      const std::vector<std::string_view> values(line.begin() + 1, line.end());
      if (line[0] == "FIELDS")
        names_ = values;
      else if (line[0] == "SIZE")
        sizes_ = values;
      else if (line[0] == "TYPE")
        types_ = values;
      else if (line[0] == "COUNT")
        counts_ = values;
      else if (line[0] == "WIDTH")
        width_ = one(values);
      else if (line[0] == "HEIGHT")
        height_ = one(values);
      else if (line[0] == "POINTS")
        points_ = one(values);
      else if (line[0] == "DATA" && values.size() == 1)
        header.data = values[0];
      else if (line[0] != "VERSION" && line[0] != "VIEWPOINT")
        cursor_.fail(fmt::format("`{}` is not a line of a header of .pcd",
                                 common::printable(std::string(line[0].substr(0, 40)))));
    }
    header.fields = fields();
    if (header.data != "ascii")
      for (Field& field : header.fields) field.column = field.column.inBinary();
    header.points = points();
    return header;
  }

 private:
  std::size_t one(const std::vector<std::string_view>& values) const {
    if (values.size() != 1) cursor_.fail("a line of the header needs one number");
    return count(cursor_, values[0]);
  }

  std::vector<Field> fields() const {
    if (names_.empty() || sizes_.size() != names_.size() || types_.size() != names_.size() ||
        (!counts_.empty() && counts_.size() != names_.size()))
      cursor_.fail("FIELDS, SIZE, TYPE and COUNT do not have as many words each");
    std::vector<Field> fields;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      Field field{{roleOf(names_[i]), pcdScalar(cursor_, types_[i], count(cursor_, sizes_[i]))}, 1};
      if (!counts_.empty()) field.count = count(cursor_, counts_[i]);
      if (field.count == 0 || field.count > 65536) cursor_.fail(fmt::format("a field has {} values", field.count));
      fields.push_back(field);
    }
    const auto has = [&](Role role) {
      return std::any_of(fields.begin(), fields.end(),
                         [role](const Field& field) { return field.column.role == role; });
    };
    if (!has(Role::kX) || !has(Role::kY) || !has(Role::kZ)) cursor_.fail("the points have no x, y and z");
    return fields;
  }

  /// Each point takes at least a byte, except in compressed files, whose size is checked when they are unpacked.
  std::size_t points() const {
    const bool has_size = width_ && height_ && (*height_ == 0 || *width_ <= SIZE_MAX / *height_);
    if (points_ && has_size && *width_ * *height_ != *points_)
      cursor_.fail(fmt::format("WIDTH {} times HEIGHT {} is not POINTS {}", *width_, *height_, *points_));
    if (points_) return *points_;
    if (has_size) return *width_ * *height_;
    cursor_.fail("the header has neither POINTS nor WIDTH and HEIGHT");
  }

  Cursor& cursor_;
  std::vector<std::string_view> names_, sizes_, types_, counts_;
  std::optional<std::size_t> width_, height_, points_;
};

/// LZF, the compression of PCL: a byte below 32 is followed by that many bytes and one more; any other holds the length
/// of a copy, less 2, in its upper three bits (7: more in the next byte) and the upper five bits of its distance,
/// less 1.
std::string unpacked(const Cursor& cursor, std::string_view packed, std::size_t size) {
  std::string bytes;
  bytes.reserve(size);
  std::size_t at = 0;
  const auto next = [&]() -> std::size_t {
    if (at == packed.size()) cursor.fail("the compressed points are cut");
    return static_cast<unsigned char>(packed[at++]);
  };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      if (packed.size() - at < control + 1) cursor.fail("the compressed points are cut");
      bytes.append(packed.substr(at, control + 1));
      at += control + 1;
    } else {
      std::size_t length = control >> 5;
      if (length == 7) length += next();
      const std::size_t distance = ((control & 31) << 8 | next()) + 1;
      if (distance > bytes.size()) cursor.fail("the compressed points refer to what is before them");
      for (std::size_t i = 0; i < length + 2; ++i) bytes.push_back(bytes[bytes.size() - distance]);
    }
    if (bytes.size() > size) cursor.fail("there are more compressed points than their header says");
  }
  if (bytes.size() != size) cursor.fail("there are fewer compressed points than their header says");
  return bytes;
}

constexpr bool kSwapped = std::endian::native != std::endian::little;

void readText(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  for (std::size_t row = 0; row < header.points; ++row) {
    cursor.beginRow();
    for (const Field& field : header.fields)
      for (std::size_t i = 0; i < field.count; ++i) {
        const double value = cursor.number();
        if (i == 0) builder.set(field.column, value);
      }
    cursor.endRow();
    builder.finish();
  }
}

void readBinary(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  const std::size_t row_bytes = header.rowBytes();
  for (std::size_t row = 0; row < header.points; ++row) {
    const char* at = cursor.take(row_bytes).data();
    for (const Field& field : header.fields) {
      builder.set(field.column, valueOf(at, field.column.type, kSwapped));
      at += field.bytes();
    }
    builder.finish();
  }
}

/// All values of the first field, then all of the second, and so on.
void readCompressed(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  const auto size = [&] { return static_cast<std::size_t>(valueOf(cursor.take(4).data(), Scalar::kUint32, kSwapped)); };
  const std::size_t packed_size = size(), unpacked_size = size(), row_bytes = header.rowBytes();
  if (row_bytes == 0 || unpacked_size % row_bytes != 0 || unpacked_size / row_bytes != header.points)
    cursor.fail("the compressed points are not as many as the header says");
  const std::string_view packed = cursor.take(packed_size);
  // Three bytes stand for at most 264.
  if (unpacked_size / 88 > packed_size) cursor.fail("there are fewer compressed points than their header says");
  const std::string bytes = unpacked(cursor, packed, unpacked_size);
  for (std::size_t row = 0; row < header.points; ++row) {
    std::size_t column = 0;
    for (const Field& field : header.fields) {
      builder.set(field.column, valueOf(&bytes[column + row * field.bytes()], field.column.type, kSwapped));
      column += header.points * field.bytes();
    }
    builder.finish();
  }
}

}  // namespace

StoredCloud parsePcd(std::string_view bytes, const std::string& name) {
  Cursor cursor(bytes, name);
  const PcdHeader header = HeaderReader(cursor).read();
  Builder builder;
  if (header.data == "ascii")
    readText(cursor, header, builder);
  else if (header.data == "binary")
    readBinary(cursor, header, builder);
  else if (header.data == "binary_compressed")
    readCompressed(cursor, header, builder);
  else
    cursor.fail(
        fmt::format("`{}` is not a kind of data of .pcd", common::printable(std::string(header.data.substr(0, 40)))));
  return builder.take();
}

}  // namespace swiftlet::interfaces
