// Files that a command writes where its user says.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swiftlet::apps {

/// Call it before the work, whose result would be lost otherwise. Throws common::InputError that names `option` for a
/// file that cannot be written, with the true reason.
void requireWritable(const std::filesystem::path& file, const std::string& option);

/// The same for a file that may not replace another's. `first_line` is what the command itself writes at the
/// start of such a file: a file of anything else is never replaced. Throws common::InputError that names `option`.
void requireWritable(const std::filesystem::path& file, const std::string& option, std::string_view first_line);

}  // namespace swiftlet::apps
