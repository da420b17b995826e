#include "interfaces/files/tum.hpp"

#include <cmath>

#include <fmt/format.h>

namespace swiftlet::interfaces {
namespace {

using common::Message;

/// Nine decimals without a negative zero, because then equal poses would differ.
std::string decimal(double value) {
  std::string text = fmt::format("{:.9f}", value);
  return text == "-0.000000000" ? text.substr(1) : text;
}

common::StampedPose poseFrom(const LineFields& fields) {
  common::StampedPose pose;
  pose.stamp = fields.stamp(0);
  pose.pose.position_m = {fields.coordinate_m(1), fields.coordinate_m(2), fields.coordinate_m(3)};
  const double x = fields.number(4), y = fields.number(5), z = fields.number(6), w = fields.number(7);
  const Eigen::Quaterniond rotation(w, x, y, z);
  if (rotation.norm() < 1e-6)
    throw fields.problemAt(4, "qx qy qz qw", Message("tum.rotation-zero", "a rotation of length zero"));
  if (!std::isfinite(rotation.norm()))
    throw fields.problemAt(4, "qx qy qz qw", Message("tum.rotation-infinite", "a rotation of infinite length"));
  pose.pose.rotation = rotation.normalized();
  return pose;
}

std::vector<common::StampedPose> read(LineReader reader, StampOrder order) {
  std::vector<common::StampedPose> poses;
  std::vector<Word> words;
  while (nextWords(reader, words)) {
    const LineFields fields(reader, words, tumFormat());
    const common::StampedPose pose = poseFrom(fields);
    if (order == StampOrder::kGrowing && !poses.empty() && pose.stamp <= poses.back().stamp)
      throw fields.problemAt(
          0, "t",
          Message("tum.not-later", "{} does not come after {}", stampText(pose.stamp), stampText(poses.back().stamp)),
          "sort the poses by time");
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

std::string toTumLine(const common::StampedPose& pose) {
  const auto& p = pose.pose.position_m;
  const auto& q = pose.pose.rotation;
  std::string line = stampText(pose.stamp);
  for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) line += " " + decimal(value);
  return line + "\n";
}

tl::expected<TumWriter, FileError> TumWriter::create(const std::filesystem::path& file) {
  return AppendFile::create(file).map([](AppendFile opened) { return TumWriter(std::move(opened)); });
}

Written TumWriter::write(const common::StampedPose& pose) {
  if (!isFinite(pose.pose)) return {};
  return file_.append(toTumLine(pose));
}

const LineFormat& tumFormat() {
  static const LineFormat kFormat{"pose", {"t", "x", "y", "z", "qx", "qy", "qz", "qw"}};
  return kFormat;
}

std::vector<common::StampedPose> readTum(const std::filesystem::path& file, StampOrder order) {
  return read(LineReader(file), order);
}

std::vector<common::StampedPose> parseTum(std::string_view text, const std::string& name, StampOrder order) {
  return read(LineReader::fromBytes(text, name), order);
}

}  // namespace swiftlet::interfaces
