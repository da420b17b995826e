#include "interfaces/clouds/point_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/printable.hpp"
#include "common/text_parts.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces::point_table {
namespace {

using common::Message;

/// Of a header's line. Some tools write a table of their own as a comment.
constexpr std::size_t kMostLineBytes = std::size_t{1} << 20;

/// The more usual name of a role comes first.
constexpr std::array<std::pair<std::string_view, Role>, 20> kRoles{{{"x", Role::kX},
                                                                    {"y", Role::kY},
                                                                    {"z", Role::kZ},
                                                                    {"nx", Role::kNormalX},
                                                                    {"ny", Role::kNormalY},
                                                                    {"nz", Role::kNormalZ},
                                                                    {"normal_x", Role::kNormalX},
                                                                    {"normal_y", Role::kNormalY},
                                                                    {"normal_z", Role::kNormalZ},
                                                                    {"red", Role::kRed},
                                                                    {"green", Role::kGreen},
                                                                    {"blue", Role::kBlue},
                                                                    {"r", Role::kRed},
                                                                    {"g", Role::kGreen},
                                                                    {"b", Role::kBlue},
                                                                    {"diffuse_red", Role::kRed},
                                                                    {"diffuse_green", Role::kGreen},
                                                                    {"diffuse_blue", Role::kBlue},
                                                                    {"rgb", Role::kPackedRgb},
                                                                    {"rgba", Role::kPackedRgb}}};

bool isBlankInLine(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isBlank(char c) { return isBlankInLine(c) || c == '\n'; }

template <typename Number>
double numberAt(const char* bytes, bool swapped) {
  std::array<char, sizeof(Number)> copy{};
  std::copy_n(bytes, copy.size(), copy.begin());
  if (swapped) std::reverse(copy.begin(), copy.end());
  Number value{};
  std::memcpy(&value, copy.data(), copy.size());
  return static_cast<double>(value);
}

/// The first names, for messages.
std::string listOf(const std::vector<std::string_view>& names) {
  constexpr std::size_t kMostNames = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    text += (i == 0 ? "" : ", ") + common::printable(names[i].substr(0, 40));
  return names.size() <= kMostNames ? text : fmt::format("{} and {} more", text, names.size() - kMostNames);
}

/// Whether a number goes on so from its point on that it is what programs on Windows write for one that is not finite:
/// `1.#QNAN`, `-1.#IND000`, and `1.#J` where two decimals are wanted, to which the letters are rounded.
bool isNotFinite(std::string_view from_point) {
  constexpr std::array<std::string_view, 9> kWords{"QNAN", "SNAN", "IND", "INF", "QNB", "QO", "IO", "R", "J"};
  if (!from_point.starts_with(".#")) return false;
  const std::string_view word = from_point.substr(2, from_point.find_last_not_of('0') - 1);
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

ColorType colorTypeOf(Scalar type) {
  if (type == Scalar::kFloat || type == Scalar::kDouble) return ColorType::kFloat;
  return bytesOf(type) == 1 ? ColorType::kByte : ColorType::kShort;
}

}  // namespace

std::size_t bytesOf(Scalar type) {
  constexpr std::array<std::size_t, 10> kBytes{1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

Cursor::Cursor(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (bytes.starts_with(kByteOrderMark)) place_ = kByteOrderMark.size();
}

void Cursor::fail(Message message, std::string hint) const {
  common::Problem problem{{name_}, "", std::move(message), std::move(hint)};
  if (text_)
    problem.location.line = lineNumber();
  else
    problem.element = fmt::format("byte {}", place_);
  throw common::InputError(std::move(problem));
}

int Cursor::lineNumber() const {
  const std::string_view before = bytes_.substr(0, word_place_);
  return static_cast<int>(1 + std::count(before.begin(), before.end(), '\n'));
}

std::string_view Cursor::line() {
  word_place_ = place_;
  const std::size_t end = bytes_.find('\n', place_);
  if (end == std::string_view::npos || end - place_ > kMostLineBytes)
    fail(Message("cloud.header-open", "the header does not end"));
  std::string_view text = bytes_.substr(place_, end - place_);
  place_ = end + 1;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string_view Cursor::take(std::size_t count) {
  text_ = false;
  if (left() < count)
    fail(Message("cloud.cut", "the file is cut: {} more bytes are needed, {} are left", count, left()));
  place_ += count;
  return bytes_.substr(place_ - count, count);
}

void Cursor::skipBlanks() {
  while (place_ < bytes_.size() && isBlankInLine(bytes_[place_])) ++place_;
  word_place_ = place_;
}

std::string Cursor::word() const {
  const std::string_view rest = bytes_.substr(place_, 20);
  return common::printable(std::string(rest.substr(0, rest.find_first_of(" \t\r\n"))));
}

std::size_t Cursor::rowsLeft() const {
  std::size_t rows = 0;
  bool blank = true;
  for (const char c : bytes_.substr(place_)) {
    if (c == '\n') blank = true;
    if (!blank || isBlank(c)) continue;
    blank = false;
    ++rows;
  }
  return rows;
}

void Cursor::beginRow() {
  while (place_ < bytes_.size() && isBlank(bytes_[place_])) ++place_;
}

void Cursor::endRow() {
  skipBlanks();
  if (place_ == bytes_.size()) return;
  if (bytes_[place_] != '\n')
    fail(Message("cloud.more-numbers", "`{}` is one number more than the header names", word()),
         "each point has a line of its own");
  ++place_;
}

double Cursor::number() {
  skipBlanks();
  const char* const begin = bytes_.data() + place_;
  const char* const end = bytes_.data() + bytes_.size();
  if (begin == end) fail(Message("cloud.cut-in-row", "the file is cut: a number is missing"));
  if (*begin == '\n')
    fail(Message("cloud.fewer-numbers", "the line has fewer numbers than the header names"),
         "each point has a line of its own");
  double value = 0.0;
  auto [stop, error] = std::from_chars(common::withoutPlus(bytes_.substr(place_)).data(), end, value);
  if (const char* const word_end = std::find_if(stop, end, isBlank);
      error == std::errc() && isNotFinite({stop - 1, word_end})) {
    value = std::numeric_limits<double>::quiet_NaN();
    stop = word_end;
  }
  if (error == std::errc::invalid_argument || (stop != end && !isBlank(*stop)))
    fail(Message("text.not-a-number", "`{}` is not a number", word()), decimalCommaHint(word()));
  // Where a number is out of range, from_chars() does not say whether it is too great: infinite, or too small: 0.
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(begin, stop).c_str(), nullptr);
  place_ = static_cast<std::size_t>(stop - bytes_.data());
  return value;
}

double valueOf(const char* bytes, Scalar type, bool swapped) {
  switch (type) {
    case Scalar::kInt8:
      return numberAt<std::int8_t>(bytes, swapped);
    case Scalar::kUint8:
      return numberAt<std::uint8_t>(bytes, swapped);
    case Scalar::kInt16:
      return numberAt<std::int16_t>(bytes, swapped);
    case Scalar::kUint16:
      return numberAt<std::uint16_t>(bytes, swapped);
    case Scalar::kInt32:
      return numberAt<std::int32_t>(bytes, swapped);
    case Scalar::kUint32:
      return numberAt<std::uint32_t>(bytes, swapped);
    case Scalar::kFloat:
      return numberAt<float>(bytes, swapped);
    case Scalar::kDouble:
      return numberAt<double>(bytes, swapped);
    case Scalar::kInt64:
      return numberAt<std::int64_t>(bytes, swapped);
    case Scalar::kUint64:
      return numberAt<std::uint64_t>(bytes, swapped);
  }
  return 0.0;
}

std::size_t count(const Cursor& cursor, std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    cursor.fail(Message("cloud.no-count", "`{}` is not a whole number from 0 on, written in digits alone",
                        common::printable(std::string(text.substr(0, 40)))));
  return value;
}

std::vector<Role> rolesOf(const Cursor& cursor, const std::vector<std::string_view>& names) {
  std::vector<Role> roles(names.size(), Role::kOther);
  const auto assign = [&](const std::vector<std::string>& spelled) {
    for (const auto& [name, role] : kRoles) {
      const auto found = std::find(spelled.begin(), spelled.end(), name);
      if (found != spelled.end() && std::find(roles.begin(), roles.end(), role) == roles.end())
        roles[static_cast<std::size_t>(found - spelled.begin())] = role;
    }
  };
  std::vector<std::string> spelled(names.begin(), names.end());
  assign(spelled);
  std::transform(names.begin(), names.end(), spelled.begin(), common::lowerCase);
  assign(spelled);
  const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
  if (!has(Role::kX) || !has(Role::kY) || !has(Role::kZ))
    cursor.fail(Message("cloud.no-position", "the points have no x, y and z, only {}", listOf(names)));
  // One of them alone is something else, for instance the range `r`.
  if (!has(Role::kRed) || !has(Role::kGreen) || !has(Role::kBlue))
    std::replace_if(
        roles.begin(), roles.end(), [](Role role) { return role >= Role::kRed && role <= Role::kBlue; }, Role::kOther);
  return roles;
}

std::string leftOutColumns(const std::vector<std::string_view>& names, const std::vector<Role>& roles) {
  std::vector<std::string_view> left_out;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (roles[i] == Role::kOther && names[i] != "_") left_out.push_back(names[i]);
  return left_out.empty() ? "" : "columns left out: " + listOf(left_out);
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t begin = 0; begin < line.size();) {
    if (isBlank(line[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < line.size() && !isBlank(line[end])) ++end;
    found.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return found;
}

void Builder::comment(const Cursor& cursor, std::string_view text) {
  if (cloud_.unit) return;
  cloud_.unit = unitIn(text);
  cloud_.unit_line = cloud_.unit ? cursor.lineNumber() : 0;
}

void Builder::note(const std::string& text) {
  if (!text.empty()) cloud_.notes.push_back(text);
}

void Builder::noteSurplus(std::size_t surplus, std::size_t promised) {
  if (surplus > 0) note(fmt::format("points left out: {} that follow the {} of the header", surplus, promised));
}

bool Builder::setPackedColor(double value, Scalar type) {
  // PCL keeps 0xAARRGGBB in the bits of a float, or as a whole number with or without a sign. Text may have the whole
  // number although the column's type is a float: as the bits of one it would be far from 0 only with an odd alpha.
  const bool floating = type == Scalar::kFloat || type == Scalar::kDouble;
  const bool whole = value > -2147483649.0 && value < 4294967296.0 && (!floating || std::abs(value) >= 1.0);
  if (std::isnan(value) || bytesOf(type) < 4 || (!whole && !floating)) return false;
  const std::uint32_t bits = whole ? static_cast<std::uint32_t>(static_cast<std::int64_t>(value))
                                   : std::bit_cast<std::uint32_t>(static_cast<float>(value));
  next_.rgb = {static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
               static_cast<std::uint8_t>(bits)};
  return true;
}

void Builder::set(const Column& column, double value) {
  const auto role = static_cast<int>(column.role);
  switch (column.role) {
    case Role::kX:
    case Role::kY:
    case Role::kZ:
      position_file_[role - static_cast<int>(Role::kX)] = value;
      return;
    case Role::kNormalX:
    case Role::kNormalY:
    case Role::kNormalZ:
      next_.normal[role - static_cast<int>(Role::kNormalX)] = static_cast<float>(value);
      return;
    case Role::kRed:
    case Role::kGreen:
    case Role::kBlue:
      color_type_ = std::max(color_type_.value_or(ColorType::kByte), colorTypeOf(column.type));
      // A byte with a sign holds the bits of one without.
      color_[static_cast<std::size_t>(role - static_cast<int>(Role::kRed))] =
          static_cast<float>(column.type == Scalar::kInt8 && value < 0.0 ? value + 256.0 : value);
      return;
    case Role::kPackedRgb:
      is_color_missing_ = !setPackedColor(value, column.type);
      return;
    case Role::kOther:
      return;
  }
}

/// The position in the map; not finite where that of the file is not, or is too great for single precision.
void Builder::place() {
  double rounding_m = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double value_m = placement_.scale * (position_file_[axis] - placement_.origin_file[axis]);
    const auto rounded_m = static_cast<float>(value_m);
    next_.position_m[axis] = rounded_m;
    rounding_m = std::max(rounding_m, std::abs(value_m - static_cast<double>(rounded_m)));
  }
  if (next_.position_m.allFinite()) cloud_.rounding_m = std::max(cloud_.rounding_m, rounding_m);
}

void Builder::finish() {
  place();
  const float length = next_.normal.norm();
  if (length > 1e-6F && std::isfinite(length))
    next_.normal /= length;
  else
    next_.normal.setZero();
  if (next_.position_m.allFinite()) {
    cloud_.points.push_back(next_);
    if (color_type_) colors_.push_back(color_);
    if (is_color_missing_) ++no_colors_;
  } else {
    ++cloud_.not_finite;
  }
  next_ = {};
  next_.rgb = common::kUnknownColor;
  color_ = {};
  is_color_missing_ = false;
}

StoredCloud Builder::take() {
  if (no_colors_ > 0)
    note(fmt::format("colours left out: those of {} points are no packed red, green and blue; a binary file keeps them",
                     no_colors_));
  if (color_type_) note(setColors(colors_, *color_type_, cloud_.points));
  return std::move(cloud_);
}

}  // namespace swiftlet::interfaces::point_table
