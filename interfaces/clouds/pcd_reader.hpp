// The reader of .pcd; see point_cloud.hpp.
#pragma once

#include <string>
#include <string_view>

#include "interfaces/clouds/stored_cloud.hpp"

namespace swiftlet::interfaces {

StoredCloud parsePcd(std::string_view bytes, const std::string& name, const CloudPlacement& placement);

}  // namespace swiftlet::interfaces
