// Messages for the operator's tablet. The operator can neither open the files of the vehicle's computer nor start the
// program with other options, so that a message there names no folder and no option.
#pragma once

#include <string>
#include <string_view>

#include "common/error.hpp"

namespace swiftlet::common {

/// The text with each path shortened to the name of its file: "/srv/kim/hall/map.yaml:3" becomes "map.yaml:3".
std::string withoutFolders(std::string_view text);

/// The problem as shown to the operator: without folders, and without a hint that only helps at the command line.
std::string forOperator(const Problem& problem);
/// The first problem, and how many more there are.
std::string forOperator(const InputError& error);

}  // namespace swiftlet::common
