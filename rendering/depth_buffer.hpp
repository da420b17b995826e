// The nearest surface at each pixel of a 3D picture, and its colour.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace swiftlet::rendering {

/// Each pixel is one number, the depth above the colour, and the smallest number wins. What is drawn therefore does not
/// depend on the order of drawing.
class DepthBuffer {
 public:
  DepthBuffer() = default;
  DepthBuffer(int width_px, int height_px)
      : width_px_(width_px),
        height_px_(height_px),
        keys_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), kEmpty) {}

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  /// The depth is positive, so its bits have the order of its values.
  static std::uint64_t keyOf(float depth_m, std::uint32_t rgb) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(depth_m)} << 32 | rgb;
  }

  bool isEmpty(int u_px, int v_px) const { return at(u_px, v_px) == kEmpty; }
  /// Along the view; infinite where nothing was drawn.
  float depth_m(int u_px, int v_px) const {
    const std::uint64_t key = at(u_px, v_px);
    return key == kEmpty ? std::numeric_limits<float>::infinity()
                         : std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
  }
  /// 0xRRGGBB.
  std::uint32_t rgb(int u_px, int v_px) const { return static_cast<std::uint32_t>(at(u_px, v_px)) & 0xffffffU; }

  /// Pixels [begin, end) of row v, which must be inside.
  void drawSpan(int v_px, int begin_px, int end_px, std::uint64_t key) {
    std::uint64_t* row = &keys_[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px_)];
    for (int u = begin_px; u < end_px; ++u) row[u] = std::min(row[u], key);
  }

 private:
  static constexpr std::uint64_t kEmpty = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t at(int u_px, int v_px) const {
    return keys_[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(u_px)];
  }

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<std::uint64_t> keys_;
};

}  // namespace swiftlet::rendering
