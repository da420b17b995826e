#include "interfaces/files/point_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/printable.hpp"

namespace swiftlet::interfaces::point_table {
namespace {

/// Of a header's line: a hundred columns take less.
constexpr std::size_t kMostLineBytes = 4096;

constexpr std::array<std::pair<std::string_view, Role>, 19> kRoles{{{"x", Role::kX},
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
                                                                    {"rgb", Role::kPackedRgb}}};

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

std::uint8_t channel(double value, Scalar type) {
  // A colour in floating point goes from 0 to 1.
  const double scaled = type == Scalar::kFloat || type == Scalar::kDouble ? 255.0 * value : value;
  return scaled >= 0.0 && scaled <= 255.0 ? static_cast<std::uint8_t>(std::lround(scaled)) : common::kUnknownColor[0];
}

}  // namespace

std::size_t bytesOf(Scalar type) {
  constexpr std::array<std::size_t, 10> kBytes{1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

Role roleOf(std::string_view name) {
  if (name == "rgba") return Role::kPackedRgb;
  const auto* const found =
      std::find_if(kRoles.begin(), kRoles.end(), [&](const auto& role) { return role.first == name; });
  return found == kRoles.end() ? Role::kOther : found->second;
}

void Cursor::fail(const std::string& message, const std::string& hint) const {
  if (!text_) throw common::InputError(common::Problem{{name_}, fmt::format("byte {}", place_), message, hint});
  const std::string_view before = bytes_.substr(0, word_place_);
  const auto line = static_cast<int>(1 + std::count(before.begin(), before.end(), '\n'));
  throw common::InputError(common::Problem{{name_, line}, "", message, hint});
}

std::string_view Cursor::line() {
  word_place_ = place_;
  const std::size_t end = bytes_.find('\n', place_);
  if (end == std::string_view::npos || end - place_ > kMostLineBytes) fail("the header does not end");
  std::string_view text = bytes_.substr(place_, end - place_);
  place_ = end + 1;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string_view Cursor::take(std::size_t count) {
  text_ = false;
  if (left() < count) fail(fmt::format("the file is cut: {} more bytes are needed, {} are left", count, left()));
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

void Cursor::beginRow() {
  while (place_ < bytes_.size() && isBlank(bytes_[place_])) ++place_;
}

void Cursor::endRow() {
  skipBlanks();
  if (place_ == bytes_.size()) return;
  if (bytes_[place_] != '\n')
    fail(fmt::format("`{}` is one number more than the header names", word()), "each point has a line of its own");
  ++place_;
}

double Cursor::number() {
  skipBlanks();
  const char* const begin = bytes_.data() + place_;
  const char* const end = bytes_.data() + bytes_.size();
  if (begin == end) fail("the file is cut: a number is missing");
  if (*begin == '\n') fail("the line has fewer numbers than the header names", "each point has a line of its own");
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin + (*begin == '+' ? 1 : 0), end, value);
  if (error == std::errc::invalid_argument || (stop != end && !isBlank(*stop)))
    fail(fmt::format("`{}` is not a number", word()));
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
    cursor.fail(fmt::format("`{}` is not a whole number", common::printable(std::string(text.substr(0, 40)))));
  return value;
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

common::SurfacePoint Builder::blank() {
  common::SurfacePoint point;
  point.rgb = common::kUnknownColor;
  return point;
}

void Builder::set(const Column& column, double value) {
  const auto role = static_cast<int>(column.role);
  switch (column.role) {
    case Role::kX:
    case Role::kY:
    case Role::kZ: {
      const auto rounded = static_cast<float>(value);
      next_.position_m[role - static_cast<int>(Role::kX)] = rounded;
      if (std::isfinite(rounded))
        cloud_.rounding_m = std::max(cloud_.rounding_m, std::abs(value - static_cast<double>(rounded)));
      return;
    }
    case Role::kNormalX:
    case Role::kNormalY:
    case Role::kNormalZ:
      next_.normal[role - static_cast<int>(Role::kNormalX)] = static_cast<float>(value);
      return;
    case Role::kRed:
    case Role::kGreen:
    case Role::kBlue:
      next_.rgb[static_cast<std::size_t>(role - static_cast<int>(Role::kRed))] = channel(value, column.type);
      return;
    case Role::kPackedRgb: {
      // PCL keeps 0xAARRGGBB in the bits of a float, or as a whole number with or without a sign.
      const std::uint32_t bits = column.type == Scalar::kFloat ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                 : value > -2147483649.0 && value < 4294967296.0
                                     ? static_cast<std::uint32_t>(static_cast<std::int64_t>(value))
                                     : 0U;
      next_.rgb = {static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
                   static_cast<std::uint8_t>(bits)};
      return;
    }
    case Role::kOther:
      return;
  }
}

void Builder::finish() {
  const float length = next_.normal.norm();
  if (length > 1e-6F && std::isfinite(length))
    next_.normal /= length;
  else
    next_.normal.setZero();
  if (next_.position_m.allFinite())
    cloud_.points.push_back(next_);
  else
    ++cloud_.not_finite;
  next_ = blank();
}

}  // namespace swiftlet::interfaces::point_table
