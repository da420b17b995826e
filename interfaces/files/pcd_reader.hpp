// The reader of .pcd; see point_cloud.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/submap3d.hpp"

namespace swiftlet::interfaces {

std::vector<common::SurfacePoint> parsePcd(std::string_view bytes, const std::string& name);

}  // namespace swiftlet::interfaces
