// Clouds of coloured points with normals in two file formats that other tools open:
//   .ply  Polygon File Format, as MeshLab, CloudCompare, Blender and Open3D open it
//   .pcd  of the Point Cloud Library, version 0.7
//
// Codecs of our own instead of PCL's: they need neither VTK nor a temporary file, and whatever a file holds, the memory
// they take is bounded by its size. Tests let PCL read what is written, and read what PCL writes.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/submap3d.hpp"
#include "common/surface_mesh.hpp"
#include "interfaces/clouds/stored_cloud.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {

enum class CloudFormat { kPly, kPcd };

/// By the ending of the name; nullopt for any other ending, also that of a packed file.
std::optional<CloudFormat> cloudFormatOf(const std::filesystem::path& file);

/// The bytes of a file, binary and little-endian. Normals and colours are written if any is known. Equal points give
/// equal bytes on every machine.
std::string toCloud(std::span<const common::SurfacePoint> points, CloudFormat format);

/// Writes the file in one step, in the format of the name's ending, which must be one of the two.
[[nodiscard]] Written writeCloud(const std::filesystem::path& file, std::span<const common::SurfacePoint> points);

/// Of files that triangles are written to; packed ones are not.
bool isMeshName(const std::filesystem::path& file);

/// Writes triangles in one step: binary as .ply, or as text as .obj (Wavefront), whose vertices have their colours
/// behind their places, as MeshLab, Blender and Open3D read them. The name's ending must be one of the two.
[[nodiscard]] Written writeMesh(const std::filesystem::path& file, const common::SurfaceMesh& mesh);

/// Reads text and binary files of either format, those of PCL compressed too, and such files packed by gzip, bzip2 or
/// xz. Names and words of the header may be in capitals. Colours and normals that a file does not have are grey and
/// unknown; faces and other columns are left out. Throws InputError for anything that is not such a file, whatever its
/// name is.
StoredCloud readCloud(const std::filesystem::path& file, const CloudPlacement& placement = {});
/// Reads the bytes of a file as readCloud() does. Messages use `name` as the file.
StoredCloud parseCloud(std::string_view bytes, const std::string& name, CloudFormat format,
                       const CloudPlacement& placement = {});

}  // namespace swiftlet::interfaces
