// Where the picture of a map is, and where the YAML of a picture. People move maps between machines, and the YAML goes
// on to name the folder of the old one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/error.hpp"

namespace swiftlet::interfaces {

struct FoundPicture {
  std::filesystem::path file;
  std::optional<common::Problem> note;  ///< If it is not where the YAML says.
};

/// The picture that a YAML names: relative to the YAML, from the root, from `~` or as a file:// address. If it is
/// missing, the same file packed (.gz, .bz2, .xz behind its name), or the file of that name beside the YAML.
/// `location`: of the name, for messages. Throws InputError, with the picture that is probably meant.
FoundPicture findPicture(const std::filesystem::path& yaml_file, const std::string& named,
                         const common::SourceLocation& location);

/// An error for a picture that was given where the YAML of a map is expected; it names the YAML beside it, if there is
/// one.
common::InputError pictureForYaml(const std::filesystem::path& picture);

}  // namespace swiftlet::interfaces
