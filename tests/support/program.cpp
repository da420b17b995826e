#include "tests/support/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

#include "tests/support/patience.hpp"

namespace swiftlet::test_support {
namespace {

struct Pipe {
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  }
  ~Pipe() {
    closeReader();
    closeWriter();
  }
  void closeReader() {
    if (ends[0] >= 0) close(ends[0]);
    ends[0] = -1;
  }
  void closeWriter() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
  std::array<int, 2> ends{};
};

[[noreturn]] void become(const std::string& name, const std::vector<std::string>& arguments,
                         const ProgramOptions& options, const Pipe& out, const Pipe& err) {
  dup2(out.ends[1], STDOUT_FILENO);
  dup2(err.ends[1], STDERR_FILENO);
  if (options.largest_file_bytes) {
    const rlimit limit{*options.largest_file_bytes, *options.largest_file_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  const std::string folder = options.working_folder.empty() ? SWIFTLET_SOURCE_DIR : options.working_folder;
  if (chdir(folder.c_str()) != 0) _exit(126);
  std::vector<char*> argv;
  std::string program = SWIFTLET_BINARY_DIR "/" + name;
  argv.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

/// Appends what is there; false at the end.
bool drain(int descriptor, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace

ProgramEnd runSwiftlet(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  return runProgram("swiftlet", arguments, options);
}

ProgramEnd runProgram(const std::string& name, const std::vector<std::string>& arguments,
                      const ProgramOptions& options) {
  Pipe out, err;
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("cannot fork");
  if (process == 0) become(name, arguments, options, out, err);
  out.closeWriter();
  err.closeWriter();

  ProgramEnd end;
  const auto deadline = std::chrono::steady_clock::now() + options.patience * patience();
  bool out_open = true, err_open = true;
  while (out_open || err_open) {
    std::array<pollfd, 2> waiting = {pollfd{out_open ? out.ends[0] : -1, POLLIN, 0},
                                     pollfd{err_open ? err.ends[0] : -1, POLLIN, 0}};
    poll(waiting.data(), waiting.size(), 20);
    if (waiting[0].revents != 0) out_open = drain(out.ends[0], end.out);
    if (waiting[1].revents != 0) err_open = drain(err.ends[0], end.err);
    if (out_open && options.hang_up_after_bytes && end.out.size() >= *options.hang_up_after_bytes) {
      out_open = false;
      out.closeReader();
    }
    if (options.while_running) options.while_running(process, end.out);
    if (!end.out_of_patience && std::chrono::steady_clock::now() > deadline) {
      end.out_of_patience = true;
      kill(process, SIGKILL);
    }
  }
  int status = 0;
  waitpid(process, &status, 0);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

std::string describe(const ProgramEnd& end) {
  std::string text = end.out_of_patience ? "took too long, killed" : "exit code " + std::to_string(end.exit_code);
  if (end.signal != 0) text += ", signal " + std::to_string(end.signal);
  const auto tail = [](const std::string& all) {
    return all.size() < 3000 ? all : "..." + all.substr(all.size() - 3000);
  };
  return text + "\n--- stdout\n" + tail(end.out) + "\n--- stderr\n" + tail(end.err);
}

}  // namespace swiftlet::test_support
