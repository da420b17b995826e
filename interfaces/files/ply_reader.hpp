// The reader of .ply; see point_cloud.hpp.
#pragma once

#include <string>
#include <string_view>

#include "interfaces/files/point_cloud.hpp"

namespace swiftlet::interfaces {

StoredCloud parsePly(std::string_view bytes, const std::string& name);

}  // namespace swiftlet::interfaces
