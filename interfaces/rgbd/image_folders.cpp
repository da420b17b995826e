#include "interfaces/rgbd/image_folders.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/rgbd/image_pairs.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::Time;

using NumberedFiles = std::map<std::int64_t, fs::path>;

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::error_code failure;
  const fs::directory_iterator entries(folder, failure);
  if (failure)
    throw common::InputError({folder.string()}, "", common::Message("file.not-reached", "{}", failure.message()));
  std::vector<fs::path> files;
  for (const auto& entry : entries) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A whole number of at most nine digits, with which the text begins; its digits are taken off the text.
std::optional<std::int64_t> takeNumber(std::string_view& text, std::int64_t greatest = 1'000'000'000) {
  std::int64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0 || number > greatest) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return number;
}

Time timeOfFrame(std::int64_t number) { return Time::fromSeconds(static_cast<double>(number) / kNumberedFrames_Hz); }

void pairByNumber(const NumberedFiles& colors, const NumberedFiles& depths, RgbdListing& listing) {
  for (const auto& [number, color] : colors) {
    const auto depth = depths.find(number);
    if (depth != depths.end()) listing.pairs.push_back({timeOfFrame(number), color, depth->second});
  }
  listing.unpaired = colors.size() + depths.size() - 2 * listing.pairs.size();
}

bool isImageFile(const fs::path& file) {
  constexpr std::array<std::string_view, 4> kEndings{".png", ".jpg", ".jpeg", ".pgm"};
  return std::find(kEndings.begin(), kEndings.end(), common::endingOf(file)) != kEndings.end();
}

/// The time in the name of an image; nullopt where it has none.
std::optional<Time> timeIn(const std::string& stem) {
  constexpr std::int64_t kGreatest_us = std::int64_t{1} << 52;
  std::string_view rest = stem;
  if (const auto index = takeNumber(rest); index && rest.starts_with('-')) {
    rest.remove_prefix(1);
    const auto time_us = takeNumber(rest, kGreatest_us);
    return time_us && rest.empty() ? std::optional(Time::fromNanoseconds(1000 * *time_us)) : std::nullopt;
  }
  return stem.find('.') == std::string::npos ? std::nullopt : parseStamp(stem);
}

/// The last number in the name.
std::optional<std::int64_t> numberIn(const std::string& stem) {
  const std::size_t end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of("0123456789", end);
  std::string_view digits(stem);
  digits = digits.substr(before == std::string::npos ? 0 : before + 1);
  return takeNumber(digits);
}

/// The images of a folder by their numbers, and by their times where most of them have some.
struct FolderImages {
  std::map<Time, fs::path> stamped;
  NumberedFiles numbered;

  explicit FolderImages(const fs::path& folder) {
    std::size_t images = 0;
    for (const fs::path& file : filesIn(folder)) {
      if (!isImageFile(file)) continue;
      ++images;
      const std::string stem = file.stem().string();
      if (const auto time = timeIn(stem)) stamped.emplace(*time, file);
      if (const auto number = numberIn(stem)) numbered.emplace(*number, file);
    }
    if (2 * stamped.size() < images) stamped.clear();
  }
};

void pairByTime(const std::map<Time, fs::path>& colors, const std::map<Time, fs::path>& depths, RgbdListing& listing) {
  const auto stampsOf = [](const std::map<Time, fs::path>& files) {
    std::vector<Time> stamps;
    for (const auto& [stamp, file] : files) stamps.push_back(stamp);
    return stamps;
  };
  const std::vector<Time> color_stamps = stampsOf(colors), depth_stamps = stampsOf(depths);
  for (const auto& [color, depth] : pairsOf(color_stamps, depth_stamps))
    listing.pairs.push_back({color_stamps[color], colors.at(color_stamps[color]), depths.at(depth_stamps[depth]), 0, 0,
                             depth_stamps[depth] - color_stamps[color]});
  listing.unpaired = colors.size() + depths.size() - 2 * listing.pairs.size();
}

std::optional<fs::path> firstFolder(const fs::path& folder, std::initializer_list<const char*> names) {
  std::error_code failure;
  for (const char* name : names)
    if (fs::is_directory(folder / name, failure)) return folder / name;
  return std::nullopt;
}

}  // namespace

void listFrameFiles(const fs::path& folder, RgbdListing& listing) {
  constexpr std::string_view kPrefix = "frame-";
  NumberedFiles colors, depths;
  for (const fs::path& file : filesIn(folder)) {
    const std::string name = file.filename().string();
    if (!name.starts_with(kPrefix)) continue;
    std::string_view rest = std::string_view(name).substr(kPrefix.size());
    const std::optional<std::int64_t> number = takeNumber(rest);
    if (!number) continue;
    if (rest == ".depth.png") depths[*number] = file;
    if (rest == ".color.png" || rest == ".color.jpg") colors[*number] = file;
  }
  pairByNumber(colors, depths, listing);
}

ImageFolders imageFoldersIn(const fs::path& folder) {
  return {firstFolder(folder, {"color", "rgb", "image"}), firstFolder(folder, {"depth"})};
}

void listTwoFolders(const fs::path& color, const fs::path& depth, RgbdListing& listing) {
  const FolderImages colors(color), depths(depth);
  if (!colors.stamped.empty() && !depths.stamped.empty())
    pairByTime(colors.stamped, depths.stamped, listing);
  else
    pairByNumber(colors.numbered, depths.numbered, listing);
}

}  // namespace swiftlet::interfaces
