#include "common/read_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

InputError problemWith(const std::filesystem::path& file, std::string message) {
  return InputError(Problem{{file.string()}, "", std::move(message), ""});
}

}  // namespace

void requireFile(const std::filesystem::path& file) {
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (std::filesystem::is_directory(status)) throw problemWith(file, "is a folder, a file was expected");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw problemWith(file, "is a pipe or a device, a file was expected");
}

std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes) {
  requireFile(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw problemWith(file, fmt::format("cannot be opened: {}", std::strerror(errno)));

  // Block by block, because files in /proc report a size of 0 and may hold any number of bytes.
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::string bytes;
  while (stream && bytes.size() <= most_bytes) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    stream.read(bytes.data() + before, kBlock);
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw problemWith(file, "cannot be read");
  if (bytes.size() > most_bytes) throw problemWith(file, fmt::format("is larger than {} bytes", most_bytes));
  return bytes;
}

}  // namespace swiftlet::common
