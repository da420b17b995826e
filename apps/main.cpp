// swiftlet: the only main(). Each subcommand is one file beside this one.
#include <exception>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "common/error.hpp"

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
    return run();
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
