// Pictures that show nothing: black behind a lens cap or in the dark, white in the sun.
#pragma once

#include "common/image.hpp"

namespace swiftlet::common {

enum class Blank { kNo, kBlack, kWhite };

/// By the mean of all channels: a lens cap leaves noise of some levels. A picture without pixels is neither.
Blank blankOf(const Image& picture);

}  // namespace swiftlet::common
