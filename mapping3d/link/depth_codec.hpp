// Depth images as few bytes, without loss: differences to the neighbour, sorted by the weight of their bytes, packed by
// zstd. Neighbouring depths differ little, so that the high bytes are nearly all 0.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

/// Before zstd, a pixel takes two bytes if all depths are whole millimetres, as those of structured light are; else
/// four. Every bit is kept in either case, those of NaN too. A pure function.
std::vector<std::uint8_t> encodeDepth(const common::DepthImage& depth);

/// An image of that size. Bytes may be anything; what is not such an image is an error with its reason, for people.
tl::expected<common::DepthImage, std::string> decodeDepth(std::span<const std::uint8_t> bytes, int width_px,
                                                          int height_px);

}  // namespace swiftlet::mapping3d
