#include "interfaces/rgbd/rgbd_listing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/core.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/median_step.hpp"
#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using common::Time;

constexpr const char* kKnownFormats =
    "expected associations.txt, or rgb.txt and depth.txt (TUM RGB-D), or frame-000000.color.png and "
    "frame-000000.depth.png (7-Scenes)";

/// No two images are compared.
constexpr double kNoneNear_s = std::numeric_limits<double>::infinity();

struct StampedFile {
  Time stamp;
  fs::path file;
};

/// A stamp and a file, from two words of a line.
StampedFile stampedFile(const LineReader& reader, const fs::path& folder, const Word& stamp, const Word& file) {
  const std::optional<Time> time = parseStamp(stamp.text);
  if (!time)
    throw reader.problemAt(stamp.column, "stamp",
                           Message("text.not-a-time", "`{}` is not a time in seconds", stamp.text),
                           stampUnitHint(stamp.text));
  return {*time, folder / fs::path(file.text)};
}

/// Throws unless a line has this many words.
void requireWords(const LineReader& reader, const std::vector<Word>& words, std::size_t count, const char* line) {
  if (words.size() == count) return;
  throw reader.problemAt(0, "",
                         Message("rgbd.word-count", "expected `{}`, this line has {} words", line, words.size()));
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

/// Images that make no pair.
struct Unpaired {
  double nearest_s = kNoneNear_s;  ///< How far apart in time the nearest two are.
  double step_s = 0.0;             ///< The median of the time from one colour image to the next.
};

Time stampOf(const StampedFile& file) { return file.stamp; }

/// The stamp of a pair is that of its colour image.
Unpaired readAssociations(const fs::path& folder, RgbdListing& listing) {
  Unpaired unpaired;
  std::vector<StampedFile> firsts;
  LineReader reader(folder / "associations.txt");
  for (std::vector<Word> words; nextWords(reader, words);) {
    requireWords(reader, words, 4, "stamp rgb_file stamp depth_file");
    const StampedFile first = stampedFile(reader, folder, words[0], words[1]);
    const StampedFile second = stampedFile(reader, folder, words[2], words[3]);
    // Some tools write depth first. The folder that both are in may have that word too.
    const bool depth_first = depthWords(words[1].text) > depthWords(words[3].text);
    if (const double apart_s = std::abs((first.stamp - second.stamp).seconds()); apart_s > kPairedWithin_s) {
      listing.unpaired += 2;
      unpaired.nearest_s = std::min(unpaired.nearest_s, apart_s);
      firsts.push_back(first);
      continue;
    }
    const StampedFile &color = depth_first ? second : first, &depth = depth_first ? first : second;
    listing.pairs.push_back({color.stamp, color.file, depth.file, depth.stamp - color.stamp});
  }
  std::stable_sort(listing.pairs.begin(), listing.pairs.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  unpaired.step_s = common::medianStep_s(firsts, stampOf);
  return unpaired;
}

/// Of two lists in the order of their stamps.
double nearestPair_s(const std::vector<StampedFile>& colors, const std::vector<StampedFile>& depths) {
  double least_s = kNoneNear_s;
  for (std::size_t c = 0, d = 0; c < colors.size() && d < depths.size();) {
    const double later_s = (colors[c].stamp - depths[d].stamp).seconds();
    least_s = std::min(least_s, std::abs(later_s));
    ++(later_s < 0.0 ? c : d);
  }
  return least_s;
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
    listing.pairs.push_back(
        {colors[color].stamp, colors[color].file, depths[depth].file, depths[depth].stamp - colors[color].stamp});
  listing.unpaired += colors.size() + depths.size() - 2 * depth_of.size();
}

/// The number in "frame-000123.color.png"; nullopt for any other name.
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
  std::error_code failure;
  const fs::directory_iterator entries(folder, failure);
  if (failure) throw InputError({folder.string()}, "", Message("file.not-reached", "{}", failure.message()));
  for (const auto& entry : entries) {
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
        {Time::fromSeconds(static_cast<double>(number) / kNumberedFrames_Hz), color, depth->second});
  }
  listing.unpaired = colors.size() + depths.size() - 2 * listing.pairs.size();
}

/// Lists in the format of TUM RGB-D that have frame numbers where times belong, as those of ICL-NUIM: whole numbers, at
/// least three, some of which follow each other. No camera has whole seconds for stamps.
bool areNumbered(const std::vector<RgbdListing::Pair>& pairs) {
  constexpr double kWhole_s = 1e-6;
  double least_step_s = kNoneNear_s;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double stamp_s = pairs[i].stamp.seconds();
    if (std::abs(stamp_s - std::round(stamp_s)) > kWhole_s) return false;
    if (i > 0) least_step_s = std::min(least_step_s, std::abs(stamp_s - pairs[i - 1].stamp.seconds()));
  }
  return pairs.size() >= 3 && least_step_s > 0.5 && least_step_s < 1.5;
}

void takeNumbersAsFrames(RgbdListing& listing) {
  if (!areNumbered(listing.pairs)) return;
  listing.stamps_per_s = kNumberedFrames_Hz;
  for (RgbdListing::Pair& pair : listing.pairs)
    pair = {Time::fromSeconds(pair.stamp.seconds() / kNumberedFrames_Hz), pair.color, pair.depth};
}

/// Whether it is there. Throws InputError where that cannot be seen.
bool isThere(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  if (failure && status.type() != fs::file_type::not_found)
    throw InputError({file.string()}, "", Message("file.not-reached", "{}", failure.message()));
  return fs::exists(status);
}

/// Why there is not a single pair.
Message whyNoPair(const RgbdListing& listing, const Unpaired& unpaired) {
  if (listing.unpaired == 0) return Message("rgbd.no-images", "lists no images");
  Message none("rgbd.no-pair", "holds no pair of a colour and a depth image, of {} images", listing.unpaired);
  if (std::isfinite(unpaired.nearest_s))
    none += fmt::format(": the nearest two are {:.3f} s apart, at most {:g} s are one time", unpaired.nearest_s,
                        kPairedWithin_s);
  return none;
}

}  // namespace

RgbdListing listRgbdFolder(const fs::path& folder, const std::string& calibration_file) {
  if (!isThere(folder) || !fs::is_directory(folder))
    throw InputError({folder.string()}, "", Message("folder.none", "is not a folder"), "unpack an archive first");
  RgbdListing listing;
  Unpaired unpaired;
  if (isThere(folder / "associations.txt")) {
    listing.format = "TUM RGB-D";
    listing.calibration = tumCalibration();
    unpaired = readAssociations(folder, listing);
    takeNumbersAsFrames(listing);
  } else if (isThere(folder / "rgb.txt") && isThere(folder / "depth.txt")) {
    listing.format = "TUM RGB-D";
    listing.calibration = tumCalibration();
    const std::vector<StampedFile> colors = readList(folder, "rgb.txt"), depths = readList(folder, "depth.txt");
    associate(colors, depths, listing);
    unpaired = {nearestPair_s(colors, depths), common::medianStep_s(colors, stampOf)};
    takeNumbersAsFrames(listing);
  } else {
    listing.format = "7-Scenes";
    listing.calibration = sevenScenesCalibration();
    listSevenScenes(folder, listing);
    if (listing.pairs.empty() && listing.unpaired == 0)
      throw InputError({folder.string()}, "", Message("rgbd.unknown-format", "holds no RGB-D frames of a known format"),
                       kKnownFormats);
  }
  if (listing.pairs.empty())
    throw InputError({folder.string()}, "", whyNoPair(listing, unpaired), stampStepNote(unpaired.step_s));
  const fs::path recorded = folder / "calibration.yaml";
  const std::string calibration = calibration_file.empty() && isThere(recorded) ? recorded.string() : calibration_file;
  if (!calibration.empty()) common::config::YamlReader::fromFile(calibration).read(listing.calibration);
  return listing;
}

}  // namespace swiftlet::interfaces
