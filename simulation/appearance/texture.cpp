#include "simulation/appearance/texture.hpp"

#include <algorithm>
#include <bit>

#include "common/check.hpp"

namespace swiftlet::simulation {
namespace {

/// Each texel is the mean of four.
std::vector<Texel> halved(const std::vector<Texel>& texels, int side) {
  const int half = side / 2;
  std::vector<Texel> smaller(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
  for (int row = 0; row < half; ++row)
    for (int column = 0; column < half; ++column) {
      const Texel* top = &texels[static_cast<std::size_t>(2 * row * side + 2 * column)];
      const Texel* bottom = top + side;
      const auto mean = [&](std::uint8_t Texel::*channel) {
        return static_cast<std::uint8_t>(
            (top[0].*channel + top[1].*channel + bottom[0].*channel + bottom[1].*channel + 2) / 4);
      };
      smaller[static_cast<std::size_t>(row * half + column)] = {mean(&Texel::red), mean(&Texel::green),
                                                                mean(&Texel::blue), mean(&Texel::paint)};
    }
  return smaller;
}

Eigen::Array4f valueOf(const Texel& texel) {
  return {static_cast<float>(texel.red), static_cast<float>(texel.green), static_cast<float>(texel.blue),
          static_cast<float>(texel.paint)};
}

// The functions of the standard library for these two are calls at the baseline instruction set.

/// For numbers that an int can hold.
int floorOf(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
}

/// The least n with value < 2^n, of a normal positive number; very small for 0.
int exponentOf(float value) { return static_cast<int>(std::bit_cast<std::uint32_t>(value) >> 23U) - 126; }

}  // namespace

Texture::Texture(int side, std::vector<Texel> texels) {
  SWIFTLET_CHECK(side > 0 && (side & (side - 1)) == 0, side);
  SWIFTLET_CHECK(texels.size() == static_cast<std::size_t>(side) * static_cast<std::size_t>(side), texels.size());
  levels_.push_back({side, std::move(texels)});
  for (; side > 1; side /= 2) levels_.push_back({side / 2, halved(levels_.back().texels, side)});
}

/// The largest version whose texels are not smaller than 0.7 of the footprint.
const Texture::Level& Texture::levelFor(float footprint) const {
  const float texels = footprint * static_cast<float>(levels_.front().side) * 0.7F;
  return levels_[static_cast<std::size_t>(std::clamp(exponentOf(texels), 0, static_cast<int>(levels_.size()) - 1))];
}

Eigen::Vector3f Texture::on(const Eigen::Vector3f& color, float u, float v, float footprint) const {
  const Level& level = levelFor(footprint);
  const auto side = static_cast<float>(level.side);
  const float x = u * side - 0.5F, y = v * side - 0.5F;
  const int column = floorOf(x), row = floorOf(y), mask = level.side - 1;
  const float right = x - static_cast<float>(column), below = y - static_cast<float>(row);
  const int left_column = column & mask, right_column = (column + 1) & mask;
  const Texel* upper = level.texels.data() + static_cast<std::ptrdiff_t>(row & mask) * level.side;
  const Texel* lower = level.texels.data() + static_cast<std::ptrdiff_t>((row + 1) & mask) * level.side;
  const Eigen::Array4f above = valueOf(upper[left_column]) * (1.0F - right) + valueOf(upper[right_column]) * right;
  const Eigen::Array4f under = valueOf(lower[left_column]) * (1.0F - right) + valueOf(lower[right_column]) * right;
  const Eigen::Array4f texel = above * (1.0F - below) + under * below;
  constexpr float kByte = 1.0F / 255.0F, kUnchanged = 1.0F / 128.0F;
  const float paint = texel[3] * kByte;
  return (texel.head<3>() * (paint * kByte + (1.0F - paint) * kUnchanged * color.array())).matrix();
}

}  // namespace swiftlet::simulation
