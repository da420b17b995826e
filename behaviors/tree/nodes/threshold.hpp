// Numbers of children in a port: negative ones are counted from the end, -1 is all of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "behaviors/tree/message.hpp"

namespace swiftlet::tree {

/// The number of children that `asked` means.
std::size_t threshold(std::int64_t asked, std::size_t children);
/// "failure_count is 5, but it has only 3 children"; nothing if there are enough of them, or the port is not known yet.
std::optional<Message> tooMany(std::string_view port, const std::optional<std::int64_t>& asked, std::size_t children);

}  // namespace swiftlet::tree
