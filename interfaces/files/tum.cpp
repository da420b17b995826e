#include "interfaces/files/tum.hpp"

#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

using common::InputError;
using common::Problem;

constexpr std::array<const char*, 8> kFields = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};

std::string stampText(common::Time stamp) {
  const std::int64_t ns = stamp.nanoseconds(), magnitude = ns < 0 ? -ns : ns;
  return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", magnitude / 1'000'000'000, magnitude % 1'000'000'000);
}

/// Nine decimals without a negative zero, which would tell two equal poses apart.
std::string decimal(double value) {
  std::string text = fmt::format("{:.9f}", value);
  return text == "-0.000000000" ? text.substr(1) : text;
}

/// Exact for plain decimals, which a double of seconds since 1970 is not.
std::optional<common::Time> parseStamp(std::string_view word) {
  double seconds = 0;
  if (!parseNumber(word, seconds) || std::abs(seconds) > 9e9) return std::nullopt;
  const std::size_t dot = word.find('.');
  const std::string_view fraction = dot == std::string_view::npos ? "" : word.substr(dot + 1);
  const bool plain = word.find_first_not_of("0123456789.") == std::string_view::npos && dot != 0;
  if (!plain || fraction.size() > 9) return common::Time::fromSeconds(seconds);
  std::int64_t whole = 0, part = 0;
  const std::string padded = std::string(fraction) + std::string(9 - fraction.size(), '0');
  std::from_chars(word.data(), word.data() + std::min(dot, word.size()), whole);
  std::from_chars(padded.data(), padded.data() + padded.size(), part);
  return common::Time::fromNanoseconds(whole * 1'000'000'000 + part);
}

common::StampedPose parsePose(std::string_view line, const std::string& name, int line_number) {
  const std::vector<Word> words = wordsOf(line);
  const auto fail = [&](int column, const std::string& element, const std::string& message) {
    return InputError(Problem{{name, line_number, column}, element, message, "expected `t x y z qx qy qz qw`"});
  };
  if (words.size() != kFields.size())
    throw fail(words.back().column, "pose", fmt::format("{} numbers instead of 8", words.size()));

  common::StampedPose pose;
  const auto stamp = parseStamp(words[0].text);
  if (!stamp) throw fail(words[0].column, "t", fmt::format("`{}` is not a time in seconds", words[0].text));
  pose.stamp = *stamp;
  std::array<double, 8> values{};
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!parseNumber(words[i].text, values[i]))
      throw fail(words[i].column, kFields[i], fmt::format("`{}` is not a finite number", words[i].text));
  pose.pose.position_m = {values[1], values[2], values[3]};
  const Eigen::Quaterniond rotation(values[7], values[4], values[5], values[6]);
  if (rotation.norm() < 1e-6) throw fail(words[4].column, "qx qy qz qw", "a rotation of length zero");
  pose.pose.rotation = rotation.normalized();
  return pose;
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

common::Trajectory readTum(const std::filesystem::path& file) {
  return parseTum(common::readBytes(file), file.string());
}

common::Trajectory parseTum(std::string_view text, const std::string& name) {
  common::Trajectory trajectory;
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = text.find('\n');
    const bool last_without_newline = end == std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(last_without_newline ? text.size() : end + 1);

    const std::vector<Word> words = wordsOf(line);
    if (words.empty() || words[0].text.starts_with('#')) continue;
    if (last_without_newline && words.size() < kFields.size()) break;
    const common::StampedPose pose = parsePose(line, name, line_number);
    if (!trajectory.empty() && pose.stamp <= trajectory.back().stamp)
      throw InputError(
          Problem{{name, line_number, words[0].column},
                  "t",
                  fmt::format("{} does not come after {}", stampText(pose.stamp), stampText(trajectory.back().stamp)),
                  "sort the poses by time"});
    trajectory.push_back(pose);
  }
  return trajectory;
}

}  // namespace swiftlet::interfaces
