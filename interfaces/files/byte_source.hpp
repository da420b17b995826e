// An interface for bytes that are read block by block.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <tl/expected.hpp>

namespace swiftlet::interfaces {

/// How many bytes were read: at most those asked for, and 0 only at the end; or why no more can be read.
using BytesRead = tl::expected<std::size_t, std::string>;
using ByteSource = std::function<BytesRead(char* to, std::size_t bytes)>;

}  // namespace swiftlet::interfaces
