// Files that are taken for meshes and are something else: CAD, or the own files of modelling programs.
#pragma once

#include <string>

namespace swiftlet::simulation {

/// A sentence on a file of which no mesh could be read, without the file's name: what kind of file it is, by its first
/// bytes or its ending, and which kinds are read. `reason` is that of the mesh's reader, which stays for files that it
/// should be able to read.
std::string explainUnreadMesh(const std::string& file, const std::string& reason);

}  // namespace swiftlet::simulation
