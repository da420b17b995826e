// Runs build/.../swiftlet as a user would and waits for its end.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace swiftlet::test_support {

struct ProgramOptions {
  std::chrono::seconds patience{240};  ///< Limit for a release build; then it is killed, which fails the test.
  std::optional<std::size_t> largest_file_bytes;   ///< Writing beyond this size fails, as on a full disk.
  std::optional<std::size_t> hang_up_after_bytes;  ///< Then its output is no longer read, as in `| head -1`.
  std::string working_folder;                      ///< The source tree if empty.
  /// Called about every 20 ms while it runs, with its process and what it has printed.
  std::function<void(pid_t, const std::string& out)> while_running;
};

struct ProgramEnd {
  int exit_code = -1;  ///< -1: ended by `signal`.
  int signal = 0;
  bool out_of_patience = false;
  std::string out;
  std::string err;
};

/// A program of the build.
ProgramEnd runProgram(const std::string& name, const std::vector<std::string>& arguments,
                      const ProgramOptions& options = {});
ProgramEnd runSwiftlet(const std::vector<std::string>& arguments, const ProgramOptions& options = {});

/// For messages of failed checks.
std::string describe(const ProgramEnd& end);

}  // namespace swiftlet::test_support
