#include "simulation/appearance/patterns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/random.hpp"
#include "common/row_major.hpp"

namespace swiftlet::simulation {
namespace {

/// Texels of 5 mm: about a pixel of a 320-pixel wide camera from 1.5 m.
constexpr int kSide = 512;
constexpr double kTexels_m = kSide / kPatternSide_m;  ///< Texels a metre.

/// Smooth noise in [-1, 1] that repeats with the texture: random values on a grid, blended between its nodes.
class GridNoise {
 public:
  /// Nodes in a row and in a column; divisors of kSide.
  GridNoise(int columns, int rows, common::RandomStream random) : columns_(columns), rows_(rows) {
    for (int i = 0; i < columns * rows; ++i) values_.push_back(static_cast<float>(random.uniform(-1.0, 1.0)));
  }
  float at(int x, int y) const {
    const int cell_x = kSide / columns_, cell_y = kSide / rows_;
    const float right = smooth(x % cell_x, cell_x), below = smooth(y % cell_y, cell_y);
    const int column = x / cell_x, row = y / cell_y;
    const float above = node(column, row) * (1.0F - right) + node(column + 1, row) * right;
    const float under = node(column, row + 1) * (1.0F - right) + node(column + 1, row + 1) * right;
    return above * (1.0F - below) + under * below;
  }

 private:
  static float smooth(int offset, int cell) {
    const float share = static_cast<float>(offset) / static_cast<float>(cell);
    return share * share * (3.0F - 2.0F * share);
  }
  float node(int column, int row) const { return values_[common::rowMajor(row % rows_, columns_, column % columns_)]; }
  int columns_, rows_;
  std::vector<float> values_;
};

/// The texture while it is made. Values are factors on the surface's colour; 1 leaves it.
class Canvas {
 public:
  Canvas(std::string name, std::uint64_t variant) : name_(std::move(name)), variant_(variant) {}

  common::RandomStream random(const char* what) const { return {variant_, name_ + " " + what}; }
  GridNoise noise(int columns, int rows, const char* what) const { return {columns, rows, random(what)}; }

  /// factor(x, y) for every texel.
  template <typename Factor>
  void fill(Factor&& factor) {
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) set(x, y, factor(x, y));
  }
  void set(int x, int y, float factor) {
    const auto value = static_cast<std::uint8_t>(std::clamp(128.0F * factor + 0.5F, 0.0F, 255.0F));
    at(x, y) = {value, value, value, 0};
  }
  /// Covers a rectangle with a colour of its own; it may reach over the edge.
  void paint(int x, int y, int width, int height, const Texel& color) {
    for (int row = y; row < y + height; ++row)
      for (int column = x; column < x + width; ++column) at(column, row) = color;
  }
  Texture take() { return {kSide, std::move(texels_)}; }

 private:
  Texel& at(int x, int y) { return texels_[common::rowMajor(y & (kSide - 1), kSide, x & (kSide - 1))]; }

  std::string name_;
  std::uint64_t variant_;
  std::vector<Texel> texels_ = std::vector<Texel>(std::size_t{kSide} * kSide);
};

void drawPlaster(Canvas& canvas) {
  const GridNoise stains = canvas.noise(8, 8, "stains"), coarse = canvas.noise(64, 64, "coarse");
  const GridNoise grain = canvas.noise(256, 256, "grain");
  canvas.fill(
      [&](int x, int y) { return 1.0F + 0.04F * stains.at(x, y) + 0.02F * coarse.at(x, y) + 0.03F * grain.at(x, y); });
}

/// Planks along x, 16 cm wide and 1.28 m long.
void drawWood(Canvas& canvas) {
  constexpr int kPlank = kSide / 16, kLength = kSide / 2;
  const GridNoise figure = canvas.noise(8, 128, "figure"), grain = canvas.noise(32, 512, "grain");
  common::RandomStream random = canvas.random("planks");
  std::array<float, 32> tone{};
  for (float& one : tone) one = static_cast<float>(random.uniform(0.75, 1.15));
  canvas.fill([&](int x, int y) {
    const int row = y / kPlank, shifted = (x + (row % 3) * kLength / 3) % kSide;
    if (y % kPlank == 0 || shifted % kLength == 0) return 0.45F;
    const float plank = tone[common::rowMajor(row, 2, shifted / kLength)];
    return plank * (1.0F + 0.18F * figure.at(x, y) + 0.10F * grain.at(x, y));
  });
}

/// Bricks of 32 cm by 8 cm with joints of 1 cm.
void drawBrick(Canvas& canvas) {
  constexpr int kLength = kSide / 8, kHeight = kSide / 32, kJoint = 2;
  const GridNoise grain = canvas.noise(256, 256, "grain");
  common::RandomStream random = canvas.random("bricks");
  std::array<float, 256> tone{};
  for (float& one : tone) one = static_cast<float>(random.uniform(0.7, 1.2));
  canvas.fill([&](int x, int y) {
    const int row = y / kHeight, shifted = (x + (row % 2) * kLength / 2) % kSide;
    const float rough = 1.0F + 0.08F * grain.at(x, y);
    if (y % kHeight < kJoint || shifted % kLength < kJoint) return 1.45F * rough;
    return tone[common::rowMajor(row, 8, shifted / kLength)] * rough;
  });
}

/// A weave of 1 cm, and squares of 32 cm in two tones.
void drawCarpet(Canvas& canvas) {
  constexpr int kSquare = kSide / 8;
  const GridNoise weave = canvas.noise(256, 256, "weave"), wear = canvas.noise(8, 8, "wear");
  common::RandomStream random = canvas.random("squares");
  std::array<float, 64> tone{};
  for (float& one : tone) one = static_cast<float>(random.uniform(0.7, 1.3));
  canvas.fill([&](int x, int y) {
    return tone[common::rowMajor(y / kSquare, 8, x / kSquare)] * (1.0F + 0.2F * weave.at(x, y)) + 0.08F * wear.at(x, y);
  });
}

/// Tiles of 32 cm with joints of 1 cm.
void drawTiles(Canvas& canvas) {
  constexpr int kTile = kSide / 8, kJoint = 2;
  const GridNoise marble = canvas.noise(32, 32, "marble"), veins = canvas.noise(128, 128, "veins");
  canvas.fill([&](int x, int y) {
    if (x % kTile < kJoint || y % kTile < kJoint) return 0.6F;
    return 1.0F + 0.06F * marble.at(x, y) + 0.03F * veins.at(x, y);
  });
}

Texel anyColor(common::RandomStream& random) {
  const auto channel = [&random] { return static_cast<std::uint8_t>(random.uniform(20.0, 240.0)); };
  const std::uint8_t red = channel(), green = channel(), blue = channel();
  return {red, green, blue, 255};
}

/// A frame with a picture of blocks, or a sheet with lines of writing.
void drawPoster(Canvas& canvas, common::RandomStream& random, int x, int y) {
  const int width = static_cast<int>(random.uniform(0.3, 0.6) * kTexels_m);
  const int height = static_cast<int>(random.uniform(0.3, 0.6) * kTexels_m);
  const bool sheet = random.chance(0.4);
  canvas.paint(x, y, width, height, sheet ? Texel{235, 235, 225, 255} : Texel{40, 35, 30, 255});
  const int border = 4, inner_width = width - 2 * border, inner_height = height - 2 * border;
  if (sheet) {
    for (int line = y + border; line + 3 < y + height - border; line += 7)
      canvas.paint(x + border, line, static_cast<int>(random.uniform(0.4, 1.0) * inner_width), 3, {50, 50, 60, 255});
    return;
  }
  canvas.paint(x + border, y + border, inner_width, inner_height, anyColor(random));
  for (int block = 0; block < 14; ++block) {
    const int block_width = static_cast<int>(random.uniform(0.08, 0.4) * inner_width);
    const int block_height = static_cast<int>(random.uniform(0.08, 0.4) * inner_height);
    const int at_x = x + border + static_cast<int>(random.uniform() * (inner_width - block_width));
    const int at_y = y + border + static_cast<int>(random.uniform() * (inner_height - block_height));
    canvas.paint(at_x, at_y, block_width, block_height, anyColor(random));
  }
}

/// One to a square of 0.85 m, some squares empty.
void drawPosters(Canvas& canvas) {
  drawPlaster(canvas);
  common::RandomStream random = canvas.random("posters");
  constexpr int kCells = 3, kCell = kSide / kCells;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const int x = column * kCell + static_cast<int>(random.uniform(0.0, 0.2) * kTexels_m);
      const int y = row * kCell + static_cast<int>(random.uniform(0.0, 0.2) * kTexels_m);
      if (random.chance(0.75)) drawPoster(canvas, random, x, y);
    }
}

/// Tufts of 4 to 16 cm with blades of 1 cm, thinner in places.
void drawLawn(Canvas& canvas) {
  const GridNoise bare = canvas.noise(8, 8, "bare"), tufts = canvas.noise(16, 16, "tufts");
  const GridNoise small = canvas.noise(64, 64, "small tufts"), blades = canvas.noise(256, 256, "blades");
  canvas.fill([&](int x, int y) {
    const float rough = 1.0F + 0.5F * bare.at(x, y);
    return 1.0F + 0.12F * tufts.at(x, y) + rough * (0.22F * small.at(x, y) + 0.25F * blades.at(x, y));
  });
}

}  // namespace

const std::vector<std::string>& patternWords() {
  static const std::vector<std::string> kWords{"blank",  "plaster", "wood",    "brick",
                                               "carpet", "tiles",   "posters", "lawn"};
  return kWords;
}

std::optional<Pattern> patternFrom(const std::string& word) {
  const auto found = std::find(patternWords().begin(), patternWords().end(), word);
  if (found == patternWords().end()) return std::nullopt;
  return static_cast<Pattern>(found - patternWords().begin());
}

Texture makePattern(Pattern pattern, std::uint64_t variant) {
  using Draw = void (*)(Canvas&);
  constexpr std::array<Draw, 8> kDraw{nullptr,    drawPlaster, drawWood,    drawBrick,
                                      drawCarpet, drawTiles,   drawPosters, drawLawn};
  const auto index = static_cast<std::size_t>(pattern);
  SWIFTLET_CHECK(pattern != Pattern::kBlank, index);
  Canvas canvas(patternWords()[index], variant);
  kDraw[index](canvas);
  return canvas.take();
}

}  // namespace swiftlet::simulation
