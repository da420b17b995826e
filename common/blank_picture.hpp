// Pictures that show nothing: black behind a lens cap or in the dark, white in the sun.
#pragma once

#include "common/image.hpp"

namespace swiftlet::common {

/// By the mean of all channels: a lens cap leaves noise of some levels. A picture without pixels is neither.
bool isBlack(const Image& picture);
bool isWhite(const Image& picture);

}  // namespace swiftlet::common
