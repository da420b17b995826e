// swiftlet version
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"

namespace swiftlet::apps {

void addVersion(Command& program) {
  auto json = std::make_shared<bool>(false);
  Command command = program.command("version", "Print the version.");
  command.flag("--json", *json, "Print as JSON.");
  command.footer("Example: swiftlet version --json");
  command.runs([json] {
    if (*json) {
      fmt::print("{}\n", nlohmann::json{{"name", "swiftlet"}, {"version", SWIFTLET_VERSION}}.dump());
    } else {
      fmt::print("swiftlet {}\n", SWIFTLET_VERSION);
    }
    return kDone;
  });
}

}  // namespace swiftlet::apps
