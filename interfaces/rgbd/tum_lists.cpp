#include "interfaces/rgbd/tum_lists.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/median_step.hpp"
#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/rgbd/image_pairs.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::Message;
using common::Time;

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
    listing.pairs.push_back({color.stamp, color.file, depth.file, 0, 0, depth.stamp - color.stamp});
  }
  std::stable_sort(listing.pairs.begin(), listing.pairs.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  unpaired.step_s = common::medianStep_s(firsts, stampOf);
  return unpaired;
}

std::vector<Time> stampsOf(const std::vector<StampedFile>& files) {
  std::vector<Time> stamps;
  for (const StampedFile& file : files) stamps.push_back(file.stamp);
  return stamps;
}

Unpaired readTwoLists(const fs::path& folder, RgbdListing& listing) {
  const std::vector<StampedFile> colors = readList(folder, "rgb.txt"), depths = readList(folder, "depth.txt");
  const std::vector<Time> color_stamps = stampsOf(colors), depth_stamps = stampsOf(depths);
  for (const auto& [color, depth] : pairsOf(color_stamps, depth_stamps))
    listing.pairs.push_back(
        {colors[color].stamp, colors[color].file, depths[depth].file, 0, 0, depths[depth].stamp - colors[color].stamp});
  listing.unpaired += colors.size() + depths.size() - 2 * listing.pairs.size();
  return {nearestPair_s(color_stamps, depth_stamps), common::medianStep_s(colors, stampOf)};
}

/// Lists in the format of TUM RGB-D that have frame numbers where times belong, as those of ICL-NUIM: whole numbers, at
/// least three, some of which follow each other. No camera has whole seconds for stamps.
bool areNumbered(const std::vector<RgbdListing::Pair>& pairs) {
  constexpr double kWhole_s = 1e-6;
  double least_step_s = std::numeric_limits<double>::infinity();
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

}  // namespace

Unpaired readTumLists(const fs::path& folder, RgbdListing& listing) {
  std::error_code failure;
  const bool associated = fs::exists(folder / "associations.txt", failure);
  const Unpaired unpaired = associated ? readAssociations(folder, listing) : readTwoLists(folder, listing);
  takeNumbersAsFrames(listing);
  return unpaired;
}

}  // namespace swiftlet::interfaces
