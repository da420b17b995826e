#include "interfaces/files/trajectory_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "interfaces/files/numbered_frames.hpp"
#include "interfaces/files/tum.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::Message;

const LineFormat& referenceFormat() {
  static const LineFormat kFormat{"pose", {"ipc_timestamp", "scan_index", "x", "y", "theta"}};
  return kFormat;
}

std::vector<common::StampedPose> readReferencePoses(LineReader reader) {
  std::vector<common::StampedPose> poses;
  std::vector<Word> words;
  while (nextWords(reader, words)) {
    const LineFields fields(reader, words, referenceFormat());
    const common::Time stamp = fields.stamp(0);
    (void)fields.number(1);
    const double x_m = fields.coordinate_m(2), y_m = fields.coordinate_m(3), yaw_rad = fields.number(4);
    poses.push_back({stamp, common::lifted({x_m, y_m, yaw_rad}, 0.0)});
  }
  return poses;
}

}  // namespace

RecordedPoses readRecordedPoses(const fs::path& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) {
    for (const char* name : {"trajectory.tum", "groundtruth.txt", "trajectory.log"})
      if (fs::exists(path / name, failure)) return readRecordedPoses(path / name);
    return readNumberedFrames(fs::is_directory(path / "pose", failure) ? path / "pose" : path);
  }
  LineReader reader(path);
  std::vector<Word> words;
  if (!nextWords(reader, words)) throw reader.problemAt(0, "", Message("poses.none", "holds no poses"));
  if (words.size() == tumFormat().fields.size()) return {PoseOrder::kStamps, readTum(path, StampOrder::kAny), 0};
  if (words.size() == referenceFormat().fields.size())
    return {PoseOrder::kStamps, readReferencePoses(LineReader(path)), 0};
  if (!areMatrices(words)) {
    const std::string commas = commaHint(words);
    throw reader.problemAt(words.back().column, "pose",
                           commas.empty() ? Message("poses.other-count", "{} numbers", words.size())
                                          : Message("poses.no-blanks", "no numbers between blanks"),
                           fmt::format("expected {}, {} or a matrix of 12 or 16 numbers{}{}", toString(tumFormat()),
                                       toString(referenceFormat()), commas.empty() ? "" : "; ", commas));
  }
  RecordedPoses found = readPoseMatrices(path);
  requireFinitePoses(found, path);
  return found;
}

std::vector<common::StampedPose> readPoses(const fs::path& file) {
  RecordedPoses found = readRecordedPoses(file);
  if (found.order == PoseOrder::kStamps) return std::move(found.poses);
  throw common::InputError({file.string()}, "", Message("poses.no-stamps", "has no stamps"),
                           fmt::format("expected {}", toString(tumFormat())));
}

std::vector<common::StampedPose> parseReferencePoses(std::string_view text, const std::string& name) {
  return readReferencePoses(LineReader::fromBytes(text, name));
}

}  // namespace swiftlet::interfaces
