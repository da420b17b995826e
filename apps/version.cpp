// swiftlet version
#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"

namespace swiftlet::apps {

void addVersion(CLI::App& program, Run& run) {
  auto* command = program.add_subcommand("version", "Print the version.");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print as JSON.");
  command->footer("Example: swiftlet version --json");
  command->callback([&run, json] {
    run = [json] {
      if (*json) {
        fmt::print("{}\n", nlohmann::json{{"name", "swiftlet"}, {"version", SWIFTLET_VERSION}}.dump());
      } else {
        fmt::print("swiftlet {}\n", SWIFTLET_VERSION);
      }
      return kDone;
    };
  });
}

}  // namespace swiftlet::apps
