// Results without which a command cannot continue.
#pragma once

#include <type_traits>
#include <utility>

#include "common/error.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

/// The value; throws InputError with the reason without one.
template <typename Made>
Made required(tl::expected<Made, interfaces::FileError> made) {
  if (!made) throw common::InputError({}, "", made.error().message);
  if constexpr (!std::is_void_v<Made>) return std::move(*made);
}

}  // namespace swiftlet::interfaces
