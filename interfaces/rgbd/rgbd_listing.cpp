#include "interfaces/rgbd/rgbd_listing.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include <fmt/core.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Problem;
using common::Time;

constexpr const char* kKnownFormats =
    "expected associations.txt, or rgb.txt and depth.txt (TUM RGB-D), or frame-000000.color.png and "
    "frame-000000.depth.png (7-Scenes)";

struct StampedFile {
  Time stamp;
  fs::path file;
};

/// A stamp and a file, from two words of a line.
StampedFile stampedFile(const LineReader& reader, const fs::path& folder, const Word& stamp, const Word& file) {
  const std::optional<Time> time = parseStamp(stamp.text);
  if (!time) throw reader.problemAt(stamp.column, "stamp", fmt::format("`{}` is not a time in seconds", stamp.text));
  return {*time, folder / fs::path(file.text)};
}

/// Throws unless a line has this many words.
void requireWords(const LineReader& reader, const std::vector<Word>& words, std::size_t count, const char* line) {
  if (words.size() == count) return;
  throw reader.problemAt(0, "", fmt::format("expected `{}`, this line has {} words", line, words.size()));
}

std::vector<StampedFile> readList(const fs::path& folder, const char* name) {
  LineReader reader(folder / name);
  std::vector<StampedFile> files;
  for (std::vector<Word> words; nextWords(reader, words);) {
    requireWords(reader, words, 2, "stamp file");
    files.push_back(stampedFile(reader, folder, words[0], words[1]));
  }
  std::stable_sort(files.begin(), files.end(),
                   [](const StampedFile& a, const StampedFile& b) { return a.stamp < b.stamp; });
  return files;
}

/// How often a path says that it is one of depth: "depth/1.png", "./depth/1.png", "1.depth.png".
int depthWords(std::string_view path) {
  constexpr std::string_view kWord = "depth";
  int count = 0;
  for (std::size_t at = path.find(kWord); at != std::string_view::npos; at = path.find(kWord, at + kWord.size()))
    ++count;
  return count;
}

/// The stamp of a pair is that of its colour image.
void readAssociations(const fs::path& folder, RgbdListing& listing) {
  LineReader reader(folder / "associations.txt");
  for (std::vector<Word> words; nextWords(reader, words);) {
    requireWords(reader, words, 4, "stamp rgb_file stamp depth_file");
    const StampedFile first = stampedFile(reader, folder, words[0], words[1]);
    const StampedFile second = stampedFile(reader, folder, words[2], words[3]);
    // Some tools write depth first. The folder that both are in may have that word too.
    const bool depth_first = depthWords(words[1].text) > depthWords(words[3].text);
    if (std::abs((first.stamp - second.stamp).seconds()) > kPairedWithin_s) {
      listing.unpaired += 2;
      continue;
    }
    const StampedFile &color = depth_first ? second : first, &depth = depth_first ? first : second;
    listing.pairs.push_back({color.stamp, color.file, depth.file});
  }
  std::stable_sort(listing.pairs.begin(), listing.pairs.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
}

/// Both in the order of their stamps; each image is used once, the nearest pairs first.
void associate(const std::vector<StampedFile>& colors, const std::vector<StampedFile>& depths, RgbdListing& listing) {
  struct Candidate {
    double apart_s;
    std::size_t color, depth;
  };
  std::vector<Candidate> candidates;
  std::size_t first = 0;
  for (std::size_t c = 0; c < colors.size(); ++c) {
    while (first < depths.size() && (colors[c].stamp - depths[first].stamp).seconds() > kPairedWithin_s) ++first;
    for (std::size_t d = first; d < depths.size(); ++d) {
      const double apart_s = (depths[d].stamp - colors[c].stamp).seconds();
      if (apart_s > kPairedWithin_s) break;
      candidates.push_back({std::abs(apart_s), c, d});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.apart_s < b.apart_s; });
  std::set<std::size_t> used_depths;
  std::map<std::size_t, std::size_t> depth_of;
  for (const Candidate& candidate : candidates) {
    if (depth_of.contains(candidate.color) || used_depths.contains(candidate.depth)) continue;
    depth_of[candidate.color] = candidate.depth;
    used_depths.insert(candidate.depth);
  }
  for (const auto& [color, depth] : depth_of)
    listing.pairs.push_back({colors[color].stamp, colors[color].file, depths[depth].file});
  listing.unpaired += colors.size() + depths.size() - 2 * depth_of.size();
}

/// The number in "frame-000123.color.png"; none for any other name.
std::optional<std::int64_t> frameNumber(const std::string& name) {
  constexpr std::string_view kPrefix = "frame-";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  std::int64_t number = 0;
  const char *begin = name.data() + kPrefix.size(), *end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest == end || *rest != '.' || number < 0 || number > 1'000'000'000) return std::nullopt;
  return number;
}

void listSevenScenes(const fs::path& folder, RgbdListing& listing) {
  std::map<std::int64_t, fs::path> colors, depths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::optional<std::int64_t> number = frameNumber(name);
    if (!number) continue;
    if (name.ends_with(".depth.png")) depths[*number] = entry.path();
    if (name.ends_with(".color.png") || name.ends_with(".color.jpg")) colors[*number] = entry.path();
  }
  for (const auto& [number, color] : colors) {
    const auto depth = depths.find(number);
    if (depth == depths.end()) continue;
    listing.pairs.push_back(
        {Time::fromSeconds(static_cast<double>(number) / kSevenScenesRate_Hz), color, depth->second});
  }
  listing.unpaired = colors.size() + depths.size() - 2 * listing.pairs.size();
}

}  // namespace

RgbdListing listRgbdFolder(const fs::path& folder, const std::string& calibration_file) {
  if (!fs::is_directory(folder))
    throw InputError(Problem{{folder.string()}, "", "is not a folder", "unpack an archive first"});
  RgbdListing listing;
  if (fs::exists(folder / "associations.txt")) {
    listing.format = "TUM RGB-D";
    listing.calibration = tumCalibration();
    readAssociations(folder, listing);
  } else if (fs::exists(folder / "rgb.txt") && fs::exists(folder / "depth.txt")) {
    listing.format = "TUM RGB-D";
    listing.calibration = tumCalibration();
    associate(readList(folder, "rgb.txt"), readList(folder, "depth.txt"), listing);
  } else {
    listing.format = "7-Scenes";
    listing.calibration = sevenScenesCalibration();
    listSevenScenes(folder, listing);
    if (listing.pairs.empty() && listing.unpaired == 0)
      throw InputError(Problem{{folder.string()}, "", "holds no RGB-D frames of a known format", kKnownFormats});
  }
  if (listing.pairs.empty())
    throw InputError(
        Problem{{folder.string()},
                "",
                fmt::format("holds no pair of a colour and a depth image, {} images are unpaired", listing.unpaired),
                ""});
  const fs::path recorded = folder / "calibration.yaml";
  const std::string calibration =
      calibration_file.empty() && fs::exists(recorded) ? recorded.string() : calibration_file;
  if (!calibration.empty()) common::config::YamlReader::fromFile(calibration).read(listing.calibration);
  return listing;
}

}  // namespace swiftlet::interfaces
