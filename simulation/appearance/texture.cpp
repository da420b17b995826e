#include "simulation/appearance/texture.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "common/check.hpp"
#include "common/row_major.hpp"

namespace swiftlet::simulation {
namespace {

/// Each texel is the mean of four.
std::vector<Texel> halved(const std::vector<Texel>& texels, int side) {
  const int half = side / 2;
  std::vector<Texel> smaller(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
  for (int row = 0; row < half; ++row)
    for (int column = 0; column < half; ++column) {
      const Texel* top = &texels[common::rowMajor(2 * row, side, 2 * column)];
      const Texel* bottom = top + side;
      const auto mean = [&](std::uint8_t Texel::*channel) {
        return static_cast<std::uint8_t>(
            (top[0].*channel + top[1].*channel + bottom[0].*channel + bottom[1].*channel + 2) / 4);
      };
      smaller[common::rowMajor(row, half, column)] = {mean(&Texel::red), mean(&Texel::green), mean(&Texel::blue),
                                                      mean(&Texel::paint)};
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

// Each texel is the mean of the pixels in it, or the pixel that it is in.
Texture Texture::of(const common::Image& image) {
  constexpr int kMostSide = 1024;
  int side = 1;
  while (side < std::max(image.width_px, image.height_px) && side < kMostSide) side *= 2;
  const auto begin = [side](int texel, int pixels) { return static_cast<int>(std::int64_t{texel} * pixels / side); };
  std::vector<Texel> texels;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const int top = begin(row, image.height_px), bottom = std::max(top + 1, begin(row + 1, image.height_px));
      const int left = begin(column, image.width_px), right = std::max(left + 1, begin(column + 1, image.width_px));
      std::array<int, 3> sum{};
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u)
          for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += image.rgb[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width_px) +
                                           static_cast<std::size_t>(u)) +
                                      channel];
      const int count = (bottom - top) * (right - left);
      const auto mean = [&](std::size_t channel) { return static_cast<std::uint8_t>(sum[channel] / count); };
      texels.push_back({mean(0), mean(1), mean(2), 255});
    }
  return {side, std::move(texels)};
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
