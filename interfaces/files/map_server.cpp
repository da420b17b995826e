#include "interfaces/files/map_server.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/read_bytes.hpp"
#include "common/validation.hpp"
#include "interfaces/files/map_picture.hpp"
#include "interfaces/files/map_picture_search.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {
namespace {

using common::CellRect;
using common::Message;
using common::OccupancyGrid;
using common::Problem;
namespace occupancy = common::occupancy;

constexpr char kOccupiedPixel = 0;
constexpr char kFreePixel = static_cast<char>(254);
constexpr char kUnknownPixel = static_cast<char>(205);

/// Of a picture that toPgm makes: more than its header takes.
constexpr std::size_t kMostHeaderBytes = 4096;

/// The cells of the picture; one cell if all are unknown.
CellRect pictured(const OccupancyGrid& grid) {
  const CellRect known = knownExtent(grid);
  return known.empty() ? CellRect{{0, 0}, {1, 1}} : known;
}

char pixelOf(occupancy::Cell cell) {
  if (occupancy::isUnknown(cell)) return kUnknownPixel;
  return occupancy::isOccupied(cell) ? kOccupiedPixel : kFreePixel;
}

/// The text as a value of YAML: in quotes where it could be read as something else.
std::string yamlValue(const std::string& text) {
  const auto isPlain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_'; };
  const auto isInner = [&](char c) { return isPlain(static_cast<unsigned char>(c)) || c == '-' || c == ' '; };
  if (!text.empty() && isPlain(static_cast<unsigned char>(text.front())) && text.back() != ' ' &&
      std::all_of(text.begin(), text.end(), isInner))
    return text;
  std::string quoted = "'";
  for (const char c : text) quoted.append(c == '\'' ? 2 : 1, c);
  return quoted + "'";
}

/// Even at the finest resolution every cell has an index.
constexpr double kMostOrigin_m = 1e6;

const std::vector<std::string> kModes = {"trinary", "scale", "raw"};
enum class Mode { kTrinary, kScale, kRaw };

/// What YAML takes for false, then for true, beside the numbers of map_server.
const std::vector<std::string> kPositive = {"0", "false", "no", "off"}, kNegated = {"1", "true", "yes", "on"};

bool isOneOf(const std::vector<std::string>& words, const std::string& text) {
  return std::find(words.begin(), words.end(), common::lowerCase(text)) != words.end();
}

struct MapYaml {
  std::string image, negate_text = "0", mode_text = "trinary";
  double resolution_m = 0.0;
  std::vector<double> origin;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;

  void describe(common::config::Fields& fields) {
    fields("image", image, "The picture, relative to this file.");
    fields("resolution", resolution_m, {1e-3, 100}, "Metres a pixel.");
    fields("origin", origin, {-kMostOrigin_m, kMostOrigin_m},
           "x, y and yaw of the lower left pixel's corner, in metres and radians.");
    fields("negate", negate_text, "1 when white is occupied.");
    fields("occupied_thresh", occupied_thresh, {0, 1}, "Probability from which a pixel is occupied.");
    fields("free_thresh", free_thresh, {0, 1}, "Probability up to which a pixel is free.");
    fields("mode", mode_text, "How pixels are understood.");
  }

  bool isNegated() const { return isOneOf(kNegated, negate_text); }
  Mode mode() const {
    return static_cast<Mode>(std::find(kModes.begin(), kModes.end(), common::lowerCase(mode_text)) - kModes.begin());
  }

  std::vector<common::Problem> validate() const {
    return common::Validation()
        .given(!image.empty(), "image")
        .require(origin.size() == 3, "origin", Message("map.origin", "is not a list of three numbers: x, y, yaw"))
        .require(isNegated() || isOneOf(kPositive, negate_text), "negate",
                 Message("map.negate", "`{}` is none of 0, 1, false, true", negate_text))
        .require(isOneOf(kModes, mode_text), "mode",
                 Message("map.mode", "`{}` is none of trinary, scale, raw", mode_text))
        .require(free_thresh < occupied_thresh, "free_thresh",
                 Message("map.thresholds", "is not below occupied_thresh"))
        .problems();
  }
};

/// The number of "`45°` is not a number", if it is followed by a sign for degrees.
std::optional<double> degreesIn(const std::string& message) {
  const std::string written = common::lowerCase(message.substr(std::min(message.find('`') + 1, message.size())));
  char* end = nullptr;
  const double value = std::strtod(written.c_str(), &end);
  std::string_view unit = end;
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  if (end == written.c_str() || !(unit.starts_with("\xC2\xB0") || unit.starts_with("\xB0") || unit.starts_with("deg")))
    return std::nullopt;
  return value;
}

/// The reader of lists does not know that the yaw is in radians, and would leave the sign for degrees out.
std::vector<Problem> readYaml(common::config::YamlReader& reader, MapYaml& yaml) {
  try {
    return reader.readKnown(yaml);
  } catch (const common::InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems)
      if (const auto yaw_deg = problem.element == "origin" ? degreesIn(problem.message.text()) : std::nullopt)
        problem.hint = fmt::format("the yaw is in radians: write `{:.6f}`", *yaw_deg * common::kRadPerDeg);
    throw common::InputError(std::move(problems));
  }
}

occupancy::Cell cellOfProbability(double probability) {
  const double odds = std::clamp(probability, 1e-6, 1 - 1e-6);
  const double steps = std::log(odds / (1 - odds)) / occupancy::kLogOddsPerStep;
  return static_cast<occupancy::Cell>(
      std::lround(std::clamp<double>(steps, -occupancy::kMaxSteps, occupancy::kMaxSteps)));
}

/// What a pixel of the modes trinary and scale is: thresholds are inclusive, as in nav2. In mode trinary the brightness
/// of unknown cells is that whatever the thresholds say: map_saver of ROS 2 writes a free_thresh of 0.25 beside it, by
/// which all that was never seen would be free. So it is in mode scale if no pixel is transparent: then nothing else
/// could say unknown.
class PixelRule {
 public:
  PixelRule(const MapYaml& yaml, const common::GreyImage& image)
      : yaml_(yaml),
        mode_(yaml.mode()),
        is_negated_(yaml.isNegated()),
        grey_is_unknown_(
            mode_ == Mode::kTrinary ||
            (mode_ == Mode::kScale && std::all_of(image.opacity.begin(), image.opacity.end(),
                                                  [](std::uint8_t opacity) { return opacity == kOpaque; }))) {}

  occupancy::Cell cellOf(std::uint8_t pixel, std::uint8_t opacity) const {
    if (mode_ == Mode::kRaw) return pixel <= 100 ? cellOfProbability(pixel / 100.0) : occupancy::kUnknown;
    // map_saver writes unknown cells of mode scale transparent; maps drawn by hand have them so in mode trinary too.
    if (opacity < (mode_ == Mode::kScale ? kOpaque : kHalfOpaque)) return occupancy::kUnknown;
    if (saysUnknown(pixel)) return occupancy::kUnknown;
    const double occupied = (255 - brightnessOf(pixel)) / 255.0;
    if (occupied >= yaml_.occupied_thresh) return occupancy::kMaxSteps;
    if (occupied <= yaml_.free_thresh) return -occupancy::kMaxSteps;
    if (mode_ == Mode::kTrinary) return occupancy::kUnknown;
    return cellOfProbability((occupied - yaml_.free_thresh) / (yaml_.occupied_thresh - yaml_.free_thresh));
  }

  /// Whether the thresholds say of the brightness of unknown cells that it is free, or in mode scale nearly so.
  bool unknownWouldBeFree() const {
    return (255 - kUnknown) / 255.0 <= (mode_ == Mode::kScale ? yaml_.occupied_thresh : yaml_.free_thresh);
  }
  /// Whether it has the brightness of unknown cells, where that means unknown, as closely as other greatest values than
  /// 255 give it.
  bool saysUnknown(std::uint8_t pixel) const {
    return grey_is_unknown_ && std::abs(brightnessOf(pixel) - kUnknown) <= 1;
  }

 private:
  static constexpr int kUnknown = static_cast<std::uint8_t>(kUnknownPixel);
  static constexpr std::uint8_t kOpaque = 255, kHalfOpaque = 128;

  int brightnessOf(std::uint8_t pixel) const { return is_negated_ ? 255 - pixel : pixel; }

  const MapYaml& yaml_;
  Mode mode_;
  bool is_negated_;
  bool grey_is_unknown_;
};

/// Of mode raw, where more than 100 percent is unknown, for which map_saver writes 255: the picture of another mode?
void noteRaw(const MapYaml& yaml, const common::GreyImage& image, std::vector<Problem>& notes) {
  if (yaml.mode() != Mode::kRaw) return;
  const auto beyond = std::count_if(image.brightness.begin(), image.brightness.end(),
                                    [](std::uint8_t pixel) { return pixel > 100 && pixel < 255; });
  if (beyond > 0)
    notes.push_back({{},
                     "mode",
                     Message("map.beyond-percent",
                             "in mode raw a pixel is the percentage of being occupied, and {} {} from 101 to 254, "
                             "taken as unknown",
                             beyond, beyond == 1 ? "is" : "are"),
                     "write `mode: trinary` if black is occupied and white is free"});
}

/// What is odd about the values of the YAML and the picture. The element is the key, without a location.
std::vector<Problem> oddities(const MapYaml& yaml, const MapPicture& picture) {
  const auto counted = [](auto count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  std::vector<Problem> notes;
  if (const std::size_t bytes = picture.left_over_bytes; bytes > 0)
    notes.push_back(
        {{},
         "image",
         Message("map.bytes-left-over", "{} after the picture's pixels are left out", counted(bytes, "byte")),
         "is the map shifted, or another file appended?"});
  if (const double yaw = yaml.origin[2]; std::abs(yaw) > 2 * std::numbers::pi)
    notes.push_back({{},
                     "origin",
                     Message("map.yaw-beyond-turn", "a yaw of {:g} rad is more than a whole turn", yaw),
                     fmt::format("if these are degrees, write {:.6f}", yaw * common::kRadPerDeg)});
  noteRaw(yaml, picture.image, notes);
  const PixelRule rule(yaml, picture.image);
  const auto& pixels = picture.image.brightness;
  const auto unknown =
      !rule.unknownWouldBeFree()
          ? 0
          : std::count_if(pixels.begin(), pixels.end(), [&](std::uint8_t pixel) { return rule.saysUnknown(pixel); });
  if (unknown > 0)
    notes.push_back(
        {{},
         yaml.mode() == Mode::kScale ? "mode" : "free_thresh",
         Message("map.unknown-as-free", "{} would make {} free that map_saver writes for unknown; taken as unknown",
                 yaml.mode() == Mode::kScale ? "scale" : fmt::format("{:g}", yaml.free_thresh),
                 counted(unknown, "pixel")),
         ""});
  return notes;
}

/// The grid of the picture. Its cells are shifted by whole cells as far as the origin asks.
StoredMap place(const common::GreyImage& image, const MapYaml& yaml) {
  const PixelRule rule(yaml, image);
  StoredMap map{.grid = common::makeOccupancyGrid(yaml.resolution_m),
                .T_map_grid = {yaml.origin[0], yaml.origin[1], yaml.origin[2]}};
  common::CellIndex corner;
  if (std::abs(map.T_map_grid.yaw_rad) < 1e-9) {
    corner = {static_cast<int>(std::lround(yaml.origin[0] / yaml.resolution_m)),
              static_cast<int>(std::lround(yaml.origin[1] / yaml.resolution_m))};
    // A yaml file has few decimals: less than a thousandth of a cell is rounding.
    const auto remainder = [&](double origin_m, int cells) {
      const double rest_m = origin_m - cells * yaml.resolution_m;
      return std::abs(rest_m) < 1e-3 * yaml.resolution_m ? 0.0 : rest_m;
    };
    map.T_map_grid = {remainder(yaml.origin[0], corner.x), remainder(yaml.origin[1], corner.y), 0.0};
  }
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const std::size_t index = static_cast<std::size_t>(row) * image.width_px + column;
      const std::uint8_t opacity = image.opacity.empty() ? 255 : image.opacity[index];
      const occupancy::Cell cell = rule.cellOf(image.brightness[index], opacity);
      if (!occupancy::isUnknown(cell)) map.grid.set({corner.x + column, corner.y + image.height_px - 1 - row}, cell);
    }
  }
  return map;
}

}  // namespace

std::string toPgm(const OccupancyGrid& grid) {
  const CellRect rect = pictured(grid);
  std::string bytes =
      fmt::format("P5\n# swiftlet {} m/pixel\n{} {}\n255\n", grid.resolution_m(), rect.width(), rect.height());
  bytes.reserve(bytes.size() + static_cast<std::size_t>(rect.width()) * rect.height());
  for (int y = rect.end.y - 1; y >= rect.begin.y; --y)
    for (int x = rect.begin.x; x < rect.end.x; ++x) bytes += pixelOf(grid.at({x, y}));
  return bytes;
}

bool isReadable(const OccupancyGrid& grid) {
  const CellRect rect = pictured(grid);
  const auto width = static_cast<std::size_t>(rect.width()), height = static_cast<std::size_t>(rect.height());
  return std::max(width, height) <= common::kMostGreySide_px &&
         width * height <= common::kMostFileBytes - kMostHeaderBytes;
}

std::string toMapYaml(const OccupancyGrid& grid, const std::string& image) {
  const CellRect rect = pictured(grid);
  // 0.196 and not 0.25: the unknown pixel 205 has probability 0.19608, and would be read as free.
  return fmt::format(
      "image: {}\nmode: trinary\nresolution: {:.6f}\norigin: [{:.6f}, {:.6f}, 0.000000]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
      yamlValue(image), grid.resolution_m(), rect.begin.x * grid.resolution_m(), rect.begin.y * grid.resolution_m());
}

Written writeMap(const std::filesystem::path& folder, const std::string& name, const OccupancyGrid& grid,
                 Durability durability) {
  return writeAtomically(folder / (name + ".pgm"), toPgm(grid), durability).and_then([&] {
    return writeAtomically(folder / (name + ".yaml"), toMapYaml(grid, name + ".pgm"), durability);
  });
}

StoredMap readMap(const std::filesystem::path& yaml_file) {
  if (isPicture(yaml_file)) throw pictureForYaml(yaml_file);
  auto reader = common::config::YamlReader::fromFile(yaml_file.string());
  MapYaml yaml;
  std::vector<Problem> notes = readYaml(reader, yaml);
  const FoundPicture found = findPicture(yaml_file, yaml.image, reader.locationOf("image"));
  if (found.note) notes.push_back(*found.note);
  const MapPicture picture = parsePicture(readUnpacked(found.file), found.file.string());
  for (Problem& note : oddities(yaml, picture)) {
    note.location = reader.locationOf(note.element);
    notes.push_back(std::move(note));
  }
  StoredMap map = place(picture.image, yaml);
  map.notes = std::move(notes);
  map.resolution_location = reader.locationOf("resolution");
  map.image_location = reader.locationOf("image");
  return map;
}

}  // namespace swiftlet::interfaces
