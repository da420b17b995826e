// What the tests of this folder share: a scratch folder and independent readers.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"

namespace swiftlet::interfaces {

namespace fs = std::filesystem;

/// A folder of the running test's own, empty at the start and removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::temp_directory_path() / ("swiftlet-" + std::string(info->test_suite_name()) + "-" + info->name() + "-" +
                                         std::to_string(::getpid()));
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  operator const fs::path&() const { return path_; }  ///< Implicit, as the folder stands for its path.
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline void put(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return std::move(bytes).str();
}

/// The objects of a file with one a line, without what a writer that was killed left of its last line.
inline std::vector<nlohmann::json> linesOfJson(const fs::path& file) {
  const std::string bytes = bytesOf(file);
  std::vector<nlohmann::json> objects;
  for (std::size_t begin = 0, end = 0; (end = bytes.find('\n', begin)) != std::string::npos; begin = end + 1)
    objects.push_back(nlohmann::json::parse(bytes.substr(begin, end - begin)));
  return objects;
}

/// What a shell command prints; none when it fails.
inline std::optional<std::string> outputOf(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string output;
  char block[4096];
  for (std::size_t count = 0; (count = std::fread(block, 1, sizeof block, pipe)) > 0;) output.append(block, count);
  return ::pclose(pipe) == 0 ? std::optional(output) : std::nullopt;
}

/// Runs `body` in a process of its own whose files may not grow beyond a size, as on a disk that is full; true when it
/// returned true.
inline bool withFullDisk(std::size_t bytes, const std::function<bool()>& body) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(body() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace swiftlet::interfaces
