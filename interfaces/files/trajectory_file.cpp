#include "interfaces/files/trajectory_file.hpp"

#include <fmt/format.h>

#include "interfaces/files/tum.hpp"

namespace swiftlet::interfaces {
namespace {

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

std::vector<common::StampedPose> readPoses(const std::filesystem::path& file) {
  LineReader reader(file);
  std::vector<Word> words;
  if (!nextWords(reader, words)) throw reader.problemAt(0, "", "holds no poses");
  if (words.size() == tumFormat().fields.size()) return readTum(file, StampOrder::kAny);
  if (words.size() == referenceFormat().fields.size()) return readReferencePoses(LineReader(file));
  const std::string commas = commaHint(words);
  throw reader.problemAt(words.back().column, "pose",
                         commas.empty() ? fmt::format("{} numbers", words.size()) : "no numbers between blanks",
                         fmt::format("expected {} or {}{}{}", toString(tumFormat()), toString(referenceFormat()),
                                     commas.empty() ? "" : "; ", commas));
}

std::vector<common::StampedPose> parseReferencePoses(std::string_view text, const std::string& name) {
  return readReferencePoses(LineReader::fromBytes(text, name));
}

}  // namespace swiftlet::interfaces
