#include "interfaces/clouds/pcd_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "common/lower_case.hpp"
#include "common/printable.hpp"
#include "interfaces/clouds/point_table.hpp"

namespace swiftlet::interfaces {
namespace {

using namespace point_table;
using common::Message;

/// A field holds `count` numbers of one type, the first of which counts, except that `rgb` may be three channels.
struct Field {
  Column column;
  std::size_t count = 1;
  std::size_t bytes() const { return count * bytesOf(column.type); }
  bool isChannels() const { return column.role == Role::kPackedRgb && count >= 3; }

  /// What the number of this index is for.
  Column at(std::size_t index) const {
    if (!isChannels()) return {index == 0 ? column.role : Role::kOther, column.type};
    return {index < 3 ? static_cast<Role>(static_cast<std::size_t>(Role::kRed) + index) : Role::kOther, column.type};
  }
  /// Takes the numbers of this field from a binary file.
  void setFrom(const char* bytes, Builder& builder) const;
};

struct PcdHeader {
  std::vector<Field> fields;
  std::string data;  ///< "ascii", "binary" or "binary_compressed".
  std::optional<std::size_t> points, width, height;

  std::size_t rowBytes() const {
    std::size_t sum = 0;
    for (const Field& field : fields) sum += field.bytes();
    return sum;
  }
  /// WIDTH times HEIGHT; old files have only WIDTH.
  std::optional<std::size_t> area() const {
    if (!width || (height && *height != 0 && *width > SIZE_MAX / *height)) return std::nullopt;
    return *width * height.value_or(1);
  }
};

Scalar pcdScalar(const Cursor& cursor, std::string_view type, std::size_t size) {
  const std::string lower = common::lowerCase(type);
  if (lower == "f" && size == 4) return Scalar::kFloat;
  if (lower == "f" && size == 8) return Scalar::kDouble;
  if (lower == "i" || lower == "u") {
    const bool sign = lower == "i";
    if (size == 1) return sign ? Scalar::kInt8 : Scalar::kUint8;
    if (size == 2) return sign ? Scalar::kInt16 : Scalar::kUint16;
    if (size == 4) return sign ? Scalar::kInt32 : Scalar::kUint32;
    if (size == 8) return sign ? Scalar::kInt64 : Scalar::kUint64;
  }
  cursor.fail(Message("pcd.no-type", "a field has the type `{}` with {} bytes",
                      common::printable(std::string(type.substr(0, 8))), size));
}

/// The lines of the header by their first word, up to DATA.
class HeaderReader {
 public:
  HeaderReader(Cursor& cursor, Builder& builder) : cursor_(cursor), builder_(builder) {}

  PcdHeader read() {
    PcdHeader header;
    while (header.data.empty()) {
      const std::string_view text = cursor_.line();
      const std::vector<std::string_view> line = words(text);
      if (line.empty() || line[0].starts_with('#')) {
        builder_.comment(cursor_, text);
        continue;
      }
      const std::string key = common::lowerCase(line[0]);
      const std::vector<std::string_view> values(line.begin() + 1, line.end());
      if (key == "fields" || key == "columns")  // COLUMNS in files before version .6.
        names_ = values;
      else if (key == "size")
        sizes_ = values;
      else if (key == "type")
        types_ = values;
      else if (key == "count")
        counts_ = values;
      else if (key == "width")
        header.width = one(values);
      else if (key == "height")
        header.height = one(values);
      else if (key == "points")
        header.points = one(values);
      else if (key == "data" && values.size() == 1)
        header.data = common::lowerCase(values[0]);
      else if (key == "viewpoint")
        noteViewpoint(values);
      else if (key != "version")
        cursor_.fail(Message("pcd.header-line", "`{}` is not a line of a header of .pcd",
                             common::printable(std::string(line[0].substr(0, 40)))));
    }
    header.fields = fields(header.data != "ascii");
    return header;
  }

 private:
  std::size_t one(const std::vector<std::string_view>& values) const {
    if (values.size() != 1) cursor_.fail(Message("pcd.no-number", "a line of the header needs one number"));
    return count(cursor_, values[0]);
  }

  /// Points are in the frame of the file to PCL too, and the pose of the sensor is beside them.
  void noteViewpoint(const std::vector<std::string_view>& values) {
    std::string pose;
    bool moved = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string value = common::printable(values[i].substr(0, 20));
      moved = moved || std::strtod(value.c_str(), nullptr) != (i == 3 ? 1.0 : 0.0);
      pose += " " + value;
    }
    if (moved) builder_.note(fmt::format("VIEWPOINT{} left out: the points stay where they are in the file", pose));
  }

  /// Files before version .6 have no SIZE and TYPE: all fields are floats there.
  std::vector<Field> fields(bool binary) {
    const auto fits = [&](const auto& values) { return values.empty() || values.size() == names_.size(); };
    if (names_.empty() || !fits(sizes_) || !fits(types_) || !fits(counts_))
      cursor_.fail(Message("pcd.word-counts", "FIELDS, SIZE, TYPE and COUNT do not have as many words each"));
    const std::vector<Role> roles = rolesOf(cursor_, names_);
    std::vector<Field> fields;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::size_t bytes = sizes_.empty() ? 4 : count(cursor_, sizes_[i]);
      Field field{{roles[i], pcdScalar(cursor_, types_.empty() ? "F" : types_[i], bytes)}, 1};
      if (!counts_.empty()) field.count = count(cursor_, counts_[i]);
      if (field.count == 0 || field.count > 65536)
        cursor_.fail(Message("pcd.field-size", "a field has {} values", field.count));
      if (binary && !field.isChannels()) field.column = field.column.inBinary();
      fields.push_back(field);
    }
    builder_.note(leftOutColumns(names_, roles));
    return fields;
  }

  Cursor& cursor_;
  Builder& builder_;
  std::vector<std::string_view> names_, sizes_, types_, counts_;
};

/// How many points to read, of `rows` that the file holds. Where the header contradicts itself, the file decides.
std::size_t pointCount(const Cursor& cursor, const PcdHeader& header, std::size_t rows, Builder& builder) {
  const std::optional<std::size_t> area = header.area();
  if (!header.points && !area)
    cursor.fail(Message("pcd.no-points", "the header has neither POINTS nor WIDTH and HEIGHT"));
  std::size_t points = header.points ? *header.points : *area;
  if (area && *area != points) {
    const Message contradiction("pcd.contradiction", "WIDTH {} times HEIGHT {} is not POINTS {}", *header.width,
                                header.height.value_or(1), points);
    if (rows != points && rows != *area)
      cursor.fail(contradiction, fmt::format("the file has {} points: write that into its header", rows));
    builder.note(fmt::format("{}: the file has {}", contradiction.text(), rows));
    points = rows;
  }
  builder.noteSurplus(rows - std::min(rows, points), points);
  return points;
}

Message fewerThanSaid() {
  return Message("pcd.packed-fewer", "the compressed points are fewer than their header says");
}

/// LZF, the compression of PCL: a byte below 32 is followed by that many bytes and one more; any other holds the length
/// of a copy, less 2, in its upper three bits (7: more in the next byte) and the upper five bits of its distance,
/// less 1. The error is why the bytes are no such data.
tl::expected<std::string, Message> unpacked(std::string_view packed, std::size_t size) {
  std::string bytes;
  bytes.reserve(size);
  std::size_t at = 0;
  while (at < packed.size()) {
    const auto byte = [&](std::size_t i) -> std::size_t { return static_cast<unsigned char>(packed[at + i]); };
    const std::size_t control = byte(0), needed = control < 32 ? control + 2 : control < 7 << 5 ? 2 : 3;
    if (packed.size() - at < needed) return tl::unexpected(Message("pcd.packed-cut", "the compressed points are cut"));
    if (control < 32) {
      bytes.append(packed.substr(at + 1, control + 1));
    } else {
      const std::size_t length = 2 + (needed == 3 ? 7 + byte(1) : control >> 5);
      const std::size_t distance = ((control & 31) << 8 | byte(needed - 1)) + 1;
      if (distance > bytes.size())
        return tl::unexpected(Message("pcd.packed-reference", "the compressed points refer to what is before them"));
      for (std::size_t i = 0; i < length; ++i) bytes.push_back(bytes[bytes.size() - distance]);
    }
    at += needed;
    if (bytes.size() > size)
      return tl::unexpected(Message("pcd.packed-more", "the compressed points are more than their header says"));
  }
  if (bytes.size() != size) return tl::unexpected(fewerThanSaid());
  return bytes;
}

constexpr bool kSwapped = std::endian::native != std::endian::little;

void Field::setFrom(const char* bytes, Builder& builder) const {
  for (std::size_t i = 0; i < (isChannels() ? count : 1); ++i)
    builder.set(at(i), valueOf(bytes + i * bytesOf(column.type), column.type, kSwapped));
}

void readText(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  const std::size_t points = pointCount(cursor, header, cursor.rowsLeft(), builder);
  for (std::size_t row = 0; row < points; ++row) {
    cursor.beginRow();
    for (const Field& field : header.fields)
      for (std::size_t i = 0; i < field.count; ++i) builder.set(field.at(i), cursor.number());
    cursor.endRow();
    builder.finish();
  }
}

void readBinary(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  const std::size_t row_bytes = header.rowBytes();
  const std::size_t points = pointCount(cursor, header, cursor.left() / row_bytes, builder);
  for (std::size_t row = 0; row < points; ++row) {
    const char* at = cursor.take(row_bytes).data();
    for (const Field& field : header.fields) {
      field.setFrom(at, builder);
      at += field.bytes();
    }
    builder.finish();
  }
}

/// All values of the first field, then all of the second, and so on.
void readCompressed(Cursor& cursor, const PcdHeader& header, Builder& builder) {
  const auto size = [&] { return static_cast<std::size_t>(valueOf(cursor.take(4).data(), Scalar::kUint32, kSwapped)); };
  const std::size_t packed_size = size(), unpacked_size = size(), row_bytes = header.rowBytes();
  const std::size_t points = pointCount(cursor, header, unpacked_size / row_bytes, builder);
  if (unpacked_size % row_bytes != 0 || unpacked_size / row_bytes != points)
    cursor.fail(Message("pcd.packed-count", "the compressed points are not as many as the header says"));
  const std::string_view packed = cursor.take(packed_size);
  // Three bytes stand for at most 264.
  if (unpacked_size / 88 > packed_size) cursor.fail(fewerThanSaid());
  tl::expected<std::string, Message> bytes = unpacked(packed, unpacked_size);
  // Points that do not become smaller are stored as they are by some tools, which the two sizes show alone.
  if (!bytes && packed_size == unpacked_size) bytes = std::string(packed);
  if (!bytes) cursor.fail(bytes.error());
  for (std::size_t row = 0; row < points; ++row) {
    std::size_t column = 0;
    for (const Field& field : header.fields) {
      field.setFrom(&(*bytes)[column + row * field.bytes()], builder);
      column += points * field.bytes();
    }
    builder.finish();
  }
}

}  // namespace

StoredCloud parsePcd(std::string_view bytes, const std::string& name, const CloudPlacement& placement) {
  Cursor cursor(bytes, name);
  Builder builder(placement);
  const PcdHeader header = HeaderReader(cursor, builder).read();
  if (header.data == "ascii")
    readText(cursor, header, builder);
  else if (header.data == "binary")
    readBinary(cursor, header, builder);
  else if (header.data == "binary_compressed")
    readCompressed(cursor, header, builder);
  else
    cursor.fail(Message("pcd.no-data-kind", "`{}` is not a kind of data of .pcd",
                        common::printable(std::string(header.data.substr(0, 40)))));
  return builder.take();
}

}  // namespace swiftlet::interfaces
