// The picture of a map as a file.
#pragma once

#include <string>

#include "rendering/map_picture.hpp"

namespace swiftlet::apps {

/// PNG, 1280 x 960 pixels.
std::string mapPng(const rendering::MapPicture& picture);

}  // namespace swiftlet::apps
