// swiftlet: the only main(). Each subcommand is one file beside this one.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "common/error.hpp"

namespace {

/// What was printed may have been lost: a full disk is told, a reader that has gone is not.
int withOutput(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  if (errno == EPIPE) return code;
  fmt::print(stderr, "the output could not be written: {}\n", std::strerror(errno));
  return swiftlet::apps::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet;

  CLI::App program{"Explore, map and fly home indoors: autonomy for small quadrotors.", "swiftlet"};
  program.require_subcommand(0, 1);  // At least one is required below, so that an unknown one is named first.
  program.footer("Example: swiftlet fly missions/explore_and_return.xml --world worlds/unb_case1.sdf --seed 7");

  apps::Run run;
  apps::addFly(program, run);
  apps::addCheck(program, run);
  apps::addTrial(program, run);
  apps::addConfig(program, run);
  apps::addDoctor(program, run);
  apps::addVersion(program, run);

  try {
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
    return withOutput(run());
  } catch (const CLI::ParseError& e) {
    return program.exit(e) == 0 ? apps::kDone : apps::kBadInput;
  } catch (const common::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return apps::kBadInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "swiftlet: {}\n", e.what());
    return apps::kBadInput;
  }
}
