// A folder in memory where there is one, for readers that take files.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace swiftlet::fuzz {

/// Of this process; gone at its end.
inline const std::filesystem::path& scratch() {
  static const struct Folder {
    Folder() {
      const std::filesystem::path memory = "/dev/shm";
      path = (std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
             ("swiftlet-fuzz-" + std::to_string(::getpid()));
      std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
  } kFolder;
  return kFolder.path;
}

inline std::string put(const std::string& name, std::string_view bytes) {
  const std::filesystem::path file = scratch() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file.string();
}

}  // namespace swiftlet::fuzz
