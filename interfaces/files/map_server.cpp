#include "interfaces/files/map_server.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/validation.hpp"

namespace swiftlet::interfaces {
namespace {

using common::CellRect;
using common::InputError;
using common::OccupancyGrid;
using common::Problem;
namespace occupancy = common::occupancy;

constexpr char kOccupiedPixel = 0;
constexpr char kFreePixel = static_cast<char>(254);
constexpr char kUnknownPixel = static_cast<char>(205);

/// Of a picture that toPgm makes: more than its header takes.
constexpr std::size_t kMostHeaderBytes = 4096;

/// The cells of the picture; one cell if nothing is known.
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

enum class Mode { kTrinary, kScale, kRaw };
enum class Negate { k0, k1, kFalse, kTrue };

struct MapYaml {
  std::string image;
  double resolution_m = 0.0;
  std::vector<double> origin;
  Negate negate = Negate::k0;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  Mode mode = Mode::kTrinary;

  void describe(common::config::Fields& fields) {
    fields("image", image, "The picture, relative to this file.");
    fields("resolution", resolution_m, {1e-3, 100}, "Metres a pixel.");
    fields("origin", origin, {-kMostOrigin_m, kMostOrigin_m},
           "x, y and yaw of the lower left pixel's corner, in metres and radians.");
    fields.choice("negate", negate, {"0", "1", "false", "true"}, "1 when white is occupied.");
    fields("occupied_thresh", occupied_thresh, {0, 1}, "Probability from which a pixel is occupied.");
    fields("free_thresh", free_thresh, {0, 1}, "Probability up to which a pixel is free.");
    fields.choice("mode", mode, {"trinary", "scale", "raw"}, "How pixels are understood.");
  }

  bool isNegated() const { return negate == Negate::k1 || negate == Negate::kTrue; }

  std::vector<std::string> validate() const {
    return common::Validation()
        .require(!image.empty(), "image", "is missing")
        .require(image.empty() || image.ends_with(".pgm"), "image",
                 fmt::format("`{}` is not a .pgm picture; convert it, for instance by ImageMagick's `convert`", image))
        .require(origin.size() == 3, "origin", "is not a list of three numbers: x, y, yaw")
        .require(free_thresh < occupied_thresh, "free_thresh", "is not below occupied_thresh")
        .problems();
  }
};

occupancy::Cell cellOfProbability(double probability) {
  const double odds = std::clamp(probability, 1e-6, 1 - 1e-6);
  const double steps = std::log(odds / (1 - odds)) / occupancy::kLogOddsPerStep;
  return static_cast<occupancy::Cell>(
      std::lround(std::clamp<double>(steps, -occupancy::kMaxSteps, occupancy::kMaxSteps)));
}

/// Thresholds are inclusive, as in nav2.
occupancy::Cell cellOf(std::uint8_t pixel, const MapYaml& yaml) {
  if (yaml.mode == Mode::kRaw) return pixel <= 100 ? cellOfProbability(pixel / 100.0) : occupancy::kUnknown;
  const double occupied = (yaml.isNegated() ? pixel : 255 - pixel) / 255.0;
  if (occupied >= yaml.occupied_thresh) return occupancy::kMaxSteps;
  if (occupied <= yaml.free_thresh) return -occupancy::kMaxSteps;
  if (yaml.mode == Mode::kTrinary) return occupancy::kUnknown;
  return cellOfProbability((occupied - yaml.free_thresh) / (yaml.occupied_thresh - yaml.free_thresh));
}

/// The header of a PGM: words between blanks, `#` to the end of the line is a comment.
class PgmHeader {
 public:
  PgmHeader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::string_view word() {
    skipBlank();
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !isBlank(bytes_[at_]) && bytes_[at_] != '#') ++at_;
    return bytes_.substr(begin, at_ - begin);
  }

  int number(const char* element, int low, int high) {
    const std::string_view text = word();
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < low || value > high)
      throw fail(element, fmt::format("`{}` is not a whole number from {} to {}", text.substr(0, 20), low, high));
    return value;
  }

  InputError fail(const char* element, const std::string& message, const std::string& hint = "") const {
    return InputError(Problem{{name_, line_}, element, message, hint});
  }

  /// Whether no word follows.
  bool atEnd() {
    skipBlank();
    return at_ >= bytes_.size();
  }

  /// The bytes after the one blank that ends the header.
  std::string_view rest() const { return bytes_.substr(std::min(at_ + 1, bytes_.size())); }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skipBlank() {
    for (bool comment = false; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '#') comment = true;
      if (c == '\n') {
        comment = false;
        ++line_;
      }
      if (!comment && !isBlank(c)) return;
    }
  }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// The grid of the picture. Its cells are shifted by whole cells as far as the origin asks.
StoredMap place(const GreyImage& image, const MapYaml& yaml) {
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
      const occupancy::Cell cell = cellOf(static_cast<std::uint8_t>(image.pixels[index]), yaml);
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
  return std::max(width, height) <= kMostSide_px && width * height <= common::kMostFileBytes - kMostHeaderBytes;
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
  auto reader = common::config::YamlReader::fromFile(yaml_file.string());
  MapYaml yaml;
  reader.read(yaml);
  const std::filesystem::path image_file = yaml_file.parent_path() / yaml.image;
  std::error_code error;
  if (!std::filesystem::exists(image_file, error))
    throw InputError(
        Problem{reader.locationOf("image"), "image",
                fmt::format("`{}`: {}", image_file.string(), error ? error.message() : std::string("no such file")),
                "it is looked for beside the YAML"});
  StoredMap map = place(parsePgm(common::readBytes(image_file), image_file.string()), yaml);
  map.resolution_location = reader.locationOf("resolution");
  map.image_location = reader.locationOf("image");
  return map;
}

GreyImage parsePgm(std::string_view bytes, const std::string& name) {
  PgmHeader header(bytes, name);
  const std::string_view magic = header.word();
  if (magic != "P5" && magic != "P2")
    throw header.fail("PGM", fmt::format("begins with `{}`, P5 or P2 was expected", magic.substr(0, 8)));
  GreyImage image;
  image.width_px = header.number("width", 1, kMostSide_px);
  image.height_px = header.number("height", 1, kMostSide_px);
  const int greatest = header.number("greatest value", 1, 65'535);
  if (greatest > 255)
    throw header.fail("greatest value", fmt::format("{} is that of 16 bits a pixel, 8 can be read", greatest),
                      "convert it, for instance by ImageMagick's `convert m.pgm -depth 8 m8.pgm`");
  const std::size_t count = static_cast<std::size_t>(image.width_px) * image.height_px;

  // Each pixel takes at least one byte. A header that promises more pixels than there are bytes must not allocate them.
  const std::string_view data = header.rest();
  if (data.size() < (magic == "P5" ? count : count - 1))
    throw header.fail("pixels", fmt::format("the file ends after {} of {} pixels", data.size(), count));
  image.pixels.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (magic == "P2" && header.atEnd())
      throw header.fail("pixels", fmt::format("the file ends after {} of {} pixels", i, count));
    const int value = magic == "P5" ? static_cast<std::uint8_t>(data[i]) : header.number("pixel", 0, greatest);
    image.pixels += static_cast<char>(std::min(value, greatest) * 255 / greatest);
  }
  return image;
}

}  // namespace swiftlet::interfaces
