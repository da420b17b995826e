// Why files cannot be written in a user's folder, with a remedy.
#pragma once

#include <filesystem>
#include <system_error>

#include "common/error.hpp"

namespace swiftlet::interfaces {

/// What keeps `folder` from being made or written into, after the system has refused it for `why`: the reason and the
/// place of the cause, which may be a folder above. The problem's location is `folder`.
common::Problem unusableFolder(const std::filesystem::path& folder, const std::error_code& why);

/// Makes the folder, with those above it, and a file in it that is removed again. Throws common::InputError with the
/// problem of unusableFolder(), which names `option`.
void requireWritableFolder(const std::filesystem::path& folder, const std::string& option);

}  // namespace swiftlet::interfaces
