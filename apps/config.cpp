// swiftlet config
#include <memory>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/system.hpp"
#include "common/printable.hpp"

namespace swiftlet::apps {

void addConfig(CLI::App& program, Run& run) {
  struct Options {
    std::string system = "swiftlet";
    bool plain = false;
    bool list = false;
  };
  auto options = std::make_shared<Options>();
  auto* command = program.add_subcommand("config", "Print the effective configuration of a system profile.");
  command->add_option("--system", options->system, "A profile of config/systems, or a file.")->capture_default_str();
  command->add_flag("--plain", options->plain, "Without the comments.");
  command->add_flag("--list", options->list, "Only the names of the profiles.");
  command->footer("Example: swiftlet config --system swiftlet > mine.yaml");
  command->callback([&run, options] {
    run = [options] {
      if (options->list) {
        for (const std::string& name : systemNames()) fmt::print("{}\n", common::printable(name));
      } else {
        fmt::print("{}", loadSystem(options->system).toYaml(!options->plain));
      }
      return kDone;
    };
  });
}

}  // namespace swiftlet::apps
