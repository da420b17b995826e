// A picture on a surface, for the cameras. It repeats itself in both directions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/image.hpp"

namespace swiftlet::simulation {

/// What a texel does to the colour of its surface. With `paint` 0 it darkens or lightens it: 128 leaves a channel as it
/// is, 255 doubles it. With `paint` 255 it covers the surface with a colour of its own. Values between mix the two.
struct Texel {
  std::uint8_t red = 128;
  std::uint8_t green = 128;
  std::uint8_t blue = 128;
  std::uint8_t paint = 0;
};

/// Immutable. Smaller versions of the picture (mip maps) serve views from afar, so that nothing flickers.
class Texture {
 public:
  /// `texels` are row by row; `side` is their number in a row and in a column, a power of two.
  Texture(int side, std::vector<Texel> texels);

  /// The image as the surface's own colours, at most 1024 texels wide and high.
  static Texture of(const common::Image& image);

  /// The colour of a surface at (u, v), where the picture covers [0, 1) x [0, 1). `footprint` is the width of a
  /// camera's pixel on the surface, in the same measure.
  Eigen::Vector3f on(const Eigen::Vector3f& color, float u, float v, float footprint) const;

 private:
  struct Level {
    int side = 0;
    std::vector<Texel> texels;
  };
  const Level& levelFor(float footprint) const;

  std::vector<Level> levels_;  ///< From the full size down to one texel.
};

}  // namespace swiftlet::simulation
