// swiftlet: the only main(). Each command is one file beside this one.
#include <fcntl.h>
#include <malloc.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "flight/build_version.hpp"

namespace {

/// A file of the run that was opened as descriptor 1 would get the progress lines.
void openStandardStreams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY);
}

/// Large blocks go back to the system when they are freed. Otherwise glibc soon keeps blocks of up to 32 MB for each
/// thread, which was a quarter of the memory of a long flight.
void returnLargeBlocks() {
#ifdef __GLIBC__
  constexpr int kLarge_bytes = 1 << 20;  // More than a picture of a camera.
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
#endif
}

/// The output may have been lost: a full disk is reported, a reader that has gone is not.
int withOutput(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  if (errno == EPIPE) return code;
  swiftlet::apps::showError(fmt::format("the output could not be written: {}\n", std::strerror(errno)));
  return swiftlet::apps::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet;
  openStandardStreams();
  returnLargeBlocks();
  // Beyond a limit of the shell (ulimit -f) a write then fails, and is reported as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);

  apps::Program program("swiftlet", toString(flight::buildVersion()),
                        "Explore, map and fly home indoors: autonomy for small quadrotors.");
  apps::Command& top = program.top();
  top.footer("Example: swiftlet fly missions/explore_and_return.xml --world worlds/unb_case1.sdf --seed 7");
  apps::addFly(top);
  apps::addCheck(top);
  apps::addNodes(top);
  apps::addFailsafe(top);
  apps::addMigrate(top);
  apps::addTrial(top);
  apps::addMap(top);
  apps::addMap3d(top);
  apps::addLocalize(top);
  apps::addConfig(top);
  apps::addDoctor(top);
  apps::addVersion(top);
  apps::addEvaluate(top);
  apps::addOptimize(top);
  apps::addConvert(top);
  apps::addIdentify(top);
  apps::addPapers(top);
  apps::addTune(top);
  apps::addConsistency(top);
  apps::addWorld(top);
  apps::addPlan(top);
  apps::addExploreBench(top);

  try {
    const auto [run, exit_code] = program.parse(argc, argv);
    return withOutput(run ? run() : exit_code);
  } catch (const common::InputError& e) {
    apps::showError(fmt::format("{}\n", e.what()));
    return apps::kBadInput;
  } catch (const std::exception& e) {
    apps::showError(fmt::format("swiftlet: {}\n", e.what()));
    return apps::kBadInput;
  }
}
