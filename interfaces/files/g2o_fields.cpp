#include "interfaces/files/g2o_fields.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace swiftlet::interfaces {

using common::Message;

void G2oFields::expectNumbers(std::size_t count) const {
  if (left() != count)
    throw problem(words_.back().column, Message("text.number-count", "{} numbers instead of {}", left(), count));
}

void G2oFields::expectInformation(std::size_t begin, std::size_t numbers, const char* hint) const {
  if (left() == begin + numbers || left() < begin) return expectNumbers(begin + numbers);
  const std::size_t given = left() - begin;
  throw problem(words_.back().column,
                given == 0 ? Message("g2o.no-information", "the information matrix ({} numbers) is missing", numbers)
                           : Message("g2o.information-count", "the information matrix has {} numbers instead of {}",
                                     given, numbers),
                hint);
}

std::int64_t G2oFields::id() {
  const Word& word = words_[next_++];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.text.data(), word.text.data() + word.text.size(), value);
  if (error != std::errc() || end != word.text.data() + word.text.size() || value < 0)
    throw problem(word.column, Message("g2o.not-an-id", "`{}` is not an id, expected 0, 1, 2 ...", word.text));
  return value;
}

double G2oFields::number(const char* name) {
  const Word& word = words_[next_++];
  double value = 0.0;
  if (!parseNumber(word.text, value))
    throw problem(word.column, name, Message("text.not-finite", "`{}` is not a finite number", word.text),
                  decimalCommaHint(word.text));
  return value;
}

double G2oFields::coordinate_m(const char* name) {
  const int begin = column();
  const double value_m = number(name);
  if (std::abs(value_m) <= kFarthest_m) return value_m;
  throw problem(begin, name, Message("text.too-far", "is farther away than {} m", kFarthest_m));
}

common::Pose2 G2oFields::pose2() {
  const double x_m = coordinate_m("x"), y_m = coordinate_m("y"), yaw_rad = number("yaw");
  return {x_m, y_m, common::wrapAngle(yaw_rad)};
}

common::Pose3 G2oFields::pose3() {
  const double x_m = coordinate_m("x"), y_m = coordinate_m("y"), z_m = coordinate_m("z");
  const int begin = column();
  const double x = number("qx"), y = number("qy"), z = number("qz"), w = number("qw");
  const Eigen::Quaterniond rotation(w, x, y, z);
  if (!(rotation.norm() > 1e-6) || !std::isfinite(rotation.norm()))
    throw problem(begin, Message("g2o.no-rotation", "a rotation of length {}", rotation.norm()));
  return {rotation.normalized(), {x_m, y_m, z_m}};
}

common::Pose3 G2oFields::pose3OfAngles() {
  const double x_m = coordinate_m("x"), y_m = coordinate_m("y"), z_m = coordinate_m("z");
  const double roll_rad = number("roll"), pitch_rad = number("pitch"), yaw_rad = number("yaw");
  return {common::quaternionFrom({roll_rad, pitch_rad, yaw_rad}), {x_m, y_m, z_m}};
}

Eigen::Matrix3d G2oFields::toroInformation() {
  Eigen::Matrix3d matrix;
  constexpr std::array<std::array<int, 2>, 6> kPlaces{{{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}}};
  for (const auto& [row, col] : kPlaces) matrix(row, col) = matrix(col, row) = number("information");
  return matrix;
}

}  // namespace swiftlet::interfaces
