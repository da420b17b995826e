// swiftlet version
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "flight/build_version.hpp"

namespace swiftlet::apps {

void addVersion(Command& program) {
  auto json = std::make_shared<bool>(false);
  Command command = program.command("version", "Print the version, with the commit that it was built from.");
  command.flag("--json", *json, "Print as JSON.");
  command.footer("Example: swiftlet version --json");
  command.runs([json] {
    if (*json) {
      const common::BuildVersion& version = flight::buildVersion();
      nlohmann::json told = {{"name", "swiftlet"}, {"version", version.number}, {"commit", version.commit}};
      told["dirty"] = version.dirty ? nlohmann::json(*version.dirty) : nlohmann::json(nullptr);
      fmt::print("{}\n", told.dump());
    } else {
      fmt::print("swiftlet {}\n", toString(flight::buildVersion()));
    }
    return kDone;
  });
}

}  // namespace swiftlet::apps
