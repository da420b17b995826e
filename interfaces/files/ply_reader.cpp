#include "interfaces/files/ply_reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/printable.hpp"
#include "interfaces/files/point_table.hpp"

namespace swiftlet::interfaces {
namespace {

using namespace point_table;

enum class Encoding { kText, kLittleEndian, kBigEndian };

/// A list has a count before its values.
struct Property {
  Column column;
  std::optional<Scalar> count_type;
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

Scalar plyScalar(const Cursor& cursor, std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> kTypes{{{"char", Scalar::kInt8},
                                                                        {"int8", Scalar::kInt8},
                                                                        {"uchar", Scalar::kUint8},
                                                                        {"uint8", Scalar::kUint8},
                                                                        {"short", Scalar::kInt16},
                                                                        {"int16", Scalar::kInt16},
                                                                        {"ushort", Scalar::kUint16},
                                                                        {"uint16", Scalar::kUint16},
                                                                        {"int", Scalar::kInt32},
                                                                        {"int32", Scalar::kInt32},
                                                                        {"uint", Scalar::kUint32},
                                                                        {"uint32", Scalar::kUint32},
                                                                        {"float", Scalar::kFloat},
                                                                        {"float32", Scalar::kFloat},
                                                                        {"double", Scalar::kDouble},
                                                                        {"float64", Scalar::kDouble}}};
  const auto* const found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.first == word; });
  if (found == kTypes.end())
    cursor.fail(fmt::format("`{}` is not a type of a property", common::printable(std::string(word.substr(0, 20)))));
  return found->second;
}

Encoding encodingOf(const Cursor& cursor, std::string_view word) {
  if (word == "ascii") return Encoding::kText;
  if (word == "binary_little_endian") return Encoding::kLittleEndian;
  if (word == "binary_big_endian") return Encoding::kBigEndian;
  cursor.fail(fmt::format("`{}` is not a format of a .ply file", common::printable(std::string(word.substr(0, 40)))));
}

Property propertyOf(const Cursor& cursor, const std::vector<std::string_view>& line) {
  if (line.size() == 3) return {{roleOf(line[2]), plyScalar(cursor, line[1])}, std::nullopt};
  if (line.size() == 5 && line[1] == "list")
    return {{Role::kOther, plyScalar(cursor, line[3])}, plyScalar(cursor, line[2])};
  cursor.fail("a property is neither `property TYPE NAME` nor `property list TYPE TYPE NAME`");
}

PlyHeader readHeader(Cursor& cursor) {
  if (cursor.line() != "ply") cursor.fail("the file does not begin with `ply`");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::vector<std::string_view> line = words(cursor.line());
    if (line.empty() || line[0] == "comment" || line[0] == "obj_info") continue;
    if (line[0] == "end_header") break;
    if (line[0] == "format" && line.size() == 3) {
      header.encoding = encodingOf(cursor, line[1]);
      has_format = true;
    } else if (line[0] == "element" && line.size() == 3) {
      header.elements.push_back({line[1], count(cursor, line[2]), {}});
    } else if (line[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(propertyOf(cursor, line));
    } else {
      cursor.fail(fmt::format("`{}` is not a line of a header", common::printable(std::string(line[0].substr(0, 40)))));
    }
  }
  if (!has_format) cursor.fail("the header has no line `format`");
  if (header.encoding != Encoding::kText)
    for (Element& element : header.elements)
      for (Property& property : element.properties) property.column = property.column.inBinary();
  return header;
}

class ElementReader {
 public:
  ElementReader(Cursor& cursor, Encoding encoding)
      : cursor_(cursor),
        text_(encoding == Encoding::kText),
        swapped_((encoding == Encoding::kBigEndian) == (std::endian::native == std::endian::little)) {}

  /// Each row of an element without properties would take nothing, and the count could be anything.
  void read(const Element& element, Builder* builder) {
    if (element.properties.empty() && element.count > 0) cursor_.fail("an element has no properties");
    for (std::size_t row = 0; row < element.count; ++row) {
      if (text_) cursor_.beginRow();
      for (const Property& property : element.properties) {
        std::size_t values = 1;
        if (property.count_type) {
          const double listed = number(*property.count_type);
          if (!(listed >= 0.0 && listed <= static_cast<double>(cursor_.left())))
            cursor_.fail(fmt::format("a list has {} values", listed));
          values = static_cast<std::size_t>(listed);
        }
        for (std::size_t i = 0; i < values; ++i) {
          const double value = number(property.column.type);
          if (builder != nullptr) builder->set(property.column, value);
        }
      }
      if (text_) cursor_.endRow();
      if (builder != nullptr) builder->finish();
    }
  }

 private:
  double number(Scalar type) {
    return text_ ? cursor_.number() : valueOf(cursor_.take(bytesOf(type)).data(), type, swapped_);
  }

  Cursor& cursor_;
  bool text_;
  bool swapped_;
};

bool has(const Element& element, Role role) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [role](const Property& property) { return property.column.role == role; });
}

}  // namespace

StoredCloud parsePly(std::string_view bytes, const std::string& name) {
  Cursor cursor(bytes, name);
  const PlyHeader header = readHeader(cursor);
  Builder builder;
  ElementReader reader(cursor, header.encoding);
  for (const Element& element : header.elements) {
    const bool points = element.name == "vertex";
    if (points && !(has(element, Role::kX) && has(element, Role::kY) && has(element, Role::kZ)))
      cursor.fail("the points have no x, y and z");
    reader.read(element, points ? &builder : nullptr);
    // What follows the points is of no use here.
    if (points) return builder.take();
  }
  cursor.fail("the file has no element `vertex`");
}

}  // namespace swiftlet::interfaces
