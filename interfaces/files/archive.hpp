// Worlds may come as archives; each is unpacked once into a cache.
#pragma once

#include <filesystem>

namespace swiftlet::interfaces {

/// Unpacks a tar archive (plain or compressed by xz, gzip, bzip2 or zstd) or a zip into a folder of its own below
/// `cache` and returns that folder. The folder is named by the archive and a hash of its bytes and appears whole: an
/// archive that is already there is not unpacked again, and if two processes unpack at once, one wins. Only files and
/// folders are unpacked, and only below the folder: an archive with a link, a device, an absolute name or `..` is
/// refused as a whole, as is one of more than 4 GiB unpacked. Throws InputError that names archive and entry.
std::filesystem::path unpackInto(const std::filesystem::path& cache, const std::filesystem::path& archive);

}  // namespace swiftlet::interfaces
