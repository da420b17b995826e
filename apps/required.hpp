// What a command cannot go on without.
#pragma once

#include <type_traits>
#include <utility>

#include "common/error.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::apps {

/// What was made or written; throws InputError that says why where it could not be.
template <typename Made>
Made required(tl::expected<Made, interfaces::FileError> made) {
  if (!made) throw common::InputError(common::Problem{{}, "", made.error().message, ""});
  if constexpr (!std::is_void_v<Made>) return std::move(*made);
}

}  // namespace swiftlet::apps
