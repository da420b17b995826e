// swiftlet check: validates missions without flying.
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/mission_limits.hpp"
#include "apps/show.hpp"

namespace swiftlet::apps {
namespace {

struct CheckOptions {
  std::vector<std::string> missions;
  std::string system = "swiftlet";
  bool json = false;
};

int check(const CheckOptions& options) {
  const System system = loadSystem(options.system);
  auto report = nlohmann::json::array();
  std::size_t count = 0;
  for (const std::string& mission : options.missions) {
    for (const common::Problem& problem : missionProblems(mission, system)) {
      ++count;
      report.push_back({{"file", problem.location.file},
                        {"line", problem.location.line},
                        {"column", problem.location.column},
                        {"element", problem.element},
                        {"message", problem.message},
                        {"hint", problem.hint}});
      if (!options.json) showError(toString(problem) + "\n");
    }
  }
  if (options.json) {
    showJson(nlohmann::json{{"problems", report}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } else if (count == 0) {
    fmt::print("{} mission{} sound\n", options.missions.size(), options.missions.size() == 1 ? " is" : "s are");
  }
  return count == 0 ? kDone : kBadInput;
}

}  // namespace

void addCheck(Command& program) {
  auto options = std::make_shared<CheckOptions>();
  Command command = program.command("check", "Validate missions without flying; every error with its place.");
  command.arguments("missions", options->missions, "Mission files.");
  command.option("--system", options->system, "The profile they are to be flown with.");
  command.flag("--json", options->json, "Print the problems as JSON.");
  command.footer("Example: swiftlet check missions/*.xml");
  command.runs([options] { return check(*options); });
}

}  // namespace swiftlet::apps
