// Files that are taken for meshes and are something else: CAD, or the own files of modelling programs.
#pragma once

#include <string>

#include "common/message.hpp"

namespace swiftlet::simulation {

/// Why no mesh could be read of a file, without the file's name: what kind of file it is, by its first bytes or its
/// ending, and which kinds are read. `reason` is that of the mesh's reader, which stays for files that it should be
/// able to read.
common::Message explainUnreadMesh(const std::string& file, const common::Message& reason);

}  // namespace swiftlet::simulation
