// Smaller pictures for streams.
#pragma once

#include "common/image.hpp"

namespace swiftlet::rendering {

/// The picture at most `width_px` wide, each new pixel the mean of the area it covers. The aspect ratio is kept. A
/// smaller picture is returned unchanged. `width_px` is positive.
common::Image shrinkToWidth(const common::Image& image, int width_px);

}  // namespace swiftlet::rendering
