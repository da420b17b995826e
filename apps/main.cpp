// swiftlet: the only main(). Each subcommand is one file beside this one.
#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/show.hpp"
#include "apps/usage.hpp"
#include "common/error.hpp"

namespace {

/// Otherwise a file of the run that gets descriptor 1 would receive the progress lines.
void openStandardStreams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY);
}

/// The output may have been lost. A full disk is reported; a reader that has gone is not.
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

  CLI::App program{"Explore, map and fly home indoors: autonomy for small quadrotors.", "swiftlet"};
  program.require_subcommand(0, 1);  // A missing subcommand is reported below, so that an unknown one is named first.
  program.set_version_flag("--version", "swiftlet " SWIFTLET_VERSION, "Print the version.");
  program.footer("Example: swiftlet fly missions/explore_and_return.xml --world worlds/unb_case1.sdf --seed 7");

  apps::Run run;
  apps::addFly(program, run);
  apps::addCheck(program, run);
  apps::addTrial(program, run);
  apps::addMap(program, run);
  apps::addLocalize(program, run);
  apps::addConfig(program, run);
  apps::addDoctor(program, run);
  apps::addVersion(program, run);
  apps::addEvaluate(program, run);
  apps::addOptimize(program, run);

  try {
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
    return withOutput(run());
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return withOutput(program.exit(e));  // Help or the version was requested.
    apps::showError(apps::usageProblem(program, e));
    return apps::kBadInput;
  } catch (const common::InputError& e) {
    apps::showError(fmt::format("{}\n", e.what()));
    return apps::kBadInput;
  } catch (const std::exception& e) {
    apps::showError(fmt::format("swiftlet: {}\n", e.what()));
    return apps::kBadInput;
  }
}
