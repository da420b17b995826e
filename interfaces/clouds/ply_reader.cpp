#include "interfaces/clouds/ply_reader.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/lower_case.hpp"
#include "common/printable.hpp"
#include "interfaces/clouds/point_table.hpp"

namespace swiftlet::interfaces {
namespace {

using namespace point_table;
using common::Message;

/// The beginning of a word of the file, for messages.
std::string shownWord(std::string_view word, std::size_t most = 40) {
  return common::printable(std::string(word.substr(0, most)));
}

enum class Encoding { kText, kLittleEndian, kBigEndian };

/// A list has a count before its values.
struct Property {
  std::string_view name;
  Column column;
  std::optional<Scalar> count_type;
};

struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  Encoding encoding = Encoding::kText;
  std::vector<PlyElement> elements;
};

Scalar plyScalar(const Cursor& cursor, std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 18> kTypes{{{"char", Scalar::kInt8},
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
                                                                        {"int64", Scalar::kInt64},
                                                                        {"uint64", Scalar::kUint64},
                                                                        {"float", Scalar::kFloat},
                                                                        {"float32", Scalar::kFloat},
                                                                        {"double", Scalar::kDouble},
                                                                        {"float64", Scalar::kDouble}}};
  const auto* const found = std::find_if(kTypes.begin(), kTypes.end(),
                                         [&](const auto& type) { return type.first == common::lowerCase(word); });
  if (found == kTypes.end())
    cursor.fail(Message("ply.no-type", "`{}` is not a type of a property", shownWord(word, 20)));
  return found->second;
}

Encoding encodingOf(const Cursor& cursor, std::string_view word) {
  const std::string lower = common::lowerCase(word);
  if (lower == "ascii") return Encoding::kText;
  if (lower == "binary_little_endian") return Encoding::kLittleEndian;
  if (lower == "binary_big_endian") return Encoding::kBigEndian;
  cursor.fail(Message("ply.no-format", "`{}` is not a format of a .ply file", shownWord(word)));
}

Property propertyOf(const Cursor& cursor, const std::vector<std::string_view>& line) {
  if (line.size() == 3) return {line[2], {Role::kOther, plyScalar(cursor, line[1])}, std::nullopt};
  if (line.size() == 5 && common::lowerCase(line[1]) == "list")
    return {line[4], {Role::kOther, plyScalar(cursor, line[3])}, plyScalar(cursor, line[2])};
  cursor.fail(
      Message("ply.property-line", "a property is neither `property TYPE NAME` nor `property list TYPE TYPE NAME`"));
}

PlyHeader readHeader(Cursor& cursor, Builder& builder) {
  const std::vector<std::string_view> first = words(cursor.line());
  if (first.size() != 1 || common::lowerCase(first[0]) != "ply")
    cursor.fail(Message("ply.other-begin", "the file does not begin with `ply`"));
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::string_view text = cursor.line();
    const std::vector<std::string_view> line = words(text);
    const std::string key = line.empty() ? "" : common::lowerCase(line[0]);
    if (key.empty()) continue;
    if (key == "end_header") break;
    if (key == "comment" || key == "obj_info") {
      builder.comment(cursor, text.substr(text.find(line[0]) + key.size()));
    } else if (key == "format" && line.size() >= 2) {
      header.encoding = encodingOf(cursor, line[1]);
      has_format = true;
    } else if (key == "element" && line.size() == 3) {
      header.elements.push_back({line[1], count(cursor, line[2]), {}});
    } else if (key == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(propertyOf(cursor, line));
    } else {
      cursor.fail(Message("ply.header-line", "`{}` is not a line of a header", shownWord(line[0])));
    }
  }
  if (!has_format) cursor.fail(Message("ply.format-missing", "the header has no line `format`"));
  return header;
}

class ElementReader {
 public:
  ElementReader(Cursor& cursor, Encoding encoding)
      : cursor_(cursor),
        text_(encoding == Encoding::kText),
        swapped_((encoding == Encoding::kBigEndian) == (std::endian::native == std::endian::little)) {}

  /// Each row of an element without properties would take nothing, and the count could be anything.
  void read(const PlyElement& element, Builder* builder) {
    if (element.properties.empty() && element.count > 0)
      cursor_.fail(Message("ply.no-properties", "an element has no properties"));
    for (std::size_t row = 0; row < element.count; ++row) {
      if (text_) cursor_.beginRow();
      for (const Property& property : element.properties) {
        std::size_t values = 1;
        if (property.count_type) {
          const double listed = number(*property.count_type);
          if (!(listed >= 0.0 && listed <= static_cast<double>(cursor_.left())))
            cursor_.fail(Message("ply.list-size", "a list has {} values", listed));
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

bool isNamed(const PlyElement& element, std::string_view name) { return common::lowerCase(element.name) == name; }

/// Assigns the roles of the points' properties, and notes those that are not used.
void assignRoles(const Cursor& cursor, PlyElement& element, bool binary, Builder& builder) {
  std::vector<std::string_view> names, scalars;
  for (const Property& property : element.properties) {
    names.push_back(property.name);
    scalars.push_back(property.count_type ? "" : property.name);
  }
  const std::vector<Role> roles = rolesOf(cursor, scalars);
  for (std::size_t i = 0; i < roles.size(); ++i) {
    Column& column = element.properties[i].column;
    column.role = roles[i];
    if (binary) column = column.inBinary();
  }
  builder.note(leftOutColumns(names, roles));
}

void noteOtherElements(const PlyHeader& header, Builder& builder) {
  for (const PlyElement& element : header.elements)
    if (element.count > 0 && !isNamed(element, "vertex"))
      builder.note(fmt::format("elements left out: {} of `{}`", element.count, common::printable(element.name)));
}

/// Whether no element with a row follows.
bool isLast(const PlyHeader& header, const PlyElement& element) {
  return std::all_of(header.elements.begin(), header.elements.end(),
                     [&](const PlyElement& other) { return &other <= &element || other.count == 0; });
}

/// The points have been read, and `bytes_before` were left before.
void noteSurplus(const Cursor& cursor, bool text, const PlyElement& points, std::size_t bytes_before,
                 Builder& builder) {
  if (points.count == 0) return;
  const std::size_t row_bytes = std::max<std::size_t>(1, (bytes_before - cursor.left()) / points.count);
  builder.noteSurplus(text ? cursor.rowsLeft() : cursor.left() / row_bytes, points.count);
}

}  // namespace

StoredCloud parsePly(std::string_view bytes, const std::string& name, const CloudPlacement& placement) {
  Cursor cursor(bytes, name);
  Builder builder(placement);
  PlyHeader header = readHeader(cursor, builder);
  ElementReader reader(cursor, header.encoding);
  for (PlyElement& element : header.elements) {
    const bool points = isNamed(element, "vertex");
    if (points) assignRoles(cursor, element, header.encoding != Encoding::kText, builder);
    const std::size_t before = cursor.left();
    reader.read(element, points ? &builder : nullptr);
    if (points && isLast(header, element))
      noteSurplus(cursor, header.encoding == Encoding::kText, element, before, builder);
    // Elements behind the points are not used here.
    if (points) {
      noteOtherElements(header, builder);
      return builder.take();
    }
  }
  cursor.fail(Message("ply.no-vertex", "the file has no element `vertex`"));
}

}  // namespace swiftlet::interfaces
