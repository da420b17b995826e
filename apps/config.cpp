// swiftlet config
#include <memory>
#include <string>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "common/config_reference.hpp"
#include "common/printable.hpp"
#include "evaluation/envelope.hpp"
#include "evaluation/trial.hpp"
#include "flight/system.hpp"

namespace swiftlet::apps {
namespace {

/// Prints the text of docs/configuration.md.
std::string reference() {
  using common::config::ReferencePrinter;
  const auto chapter = [](const char* title, const char* sentence, const auto& config) {
    return "\n" + ReferencePrinter().print(title, sentence, config);
  };
  return "# Every setting\n\n"
         "Printed by `swiftlet config --reference`. The last word of a name is its unit. A value out of its bounds is "
         "refused, as is a\nkey that is not here; both ends of the bounds are allowed. How a profile is made: "
         "[profile](tutorials/profile.md).\n" +
         chapter("System profile",
                 "A file of `config/systems`. `swiftlet config --system NAME` prints what is in force.",
                 flight::SystemConfig()) +
         chapter("Vehicle", "A file of `config/vehicles`.", common::VehicleConfig()) +
         chapter("Laser", "A file of `config/sensors`.", common::LaserConfig()) +
         chapter("RGB-D camera", "A file of `config/sensors`.", common::RgbdCameraConfig()) +
         chapter("Trial", "A file of `trials`, see [trials](tutorials/trials.md).", evaluation::TrialConfig()) +
         chapter("Envelope", "A file such as `config/envelope.yaml`, see [envelope](envelope.md).",
                 evaluation::EnvelopeConfig());
}

}  // namespace

void addConfig(Command& program) {
  struct Options {
    std::string system = "swiftlet";
    bool plain = false;
    bool list = false;
    bool reference = false;
  };
  auto options = std::make_shared<Options>();
  Command command = program.command("config", "Print the effective configuration of a system profile.");
  command.option("--system", options->system, "A profile of config/systems, or a file.");
  command.flag("--plain", options->plain, "Without the comments.");
  command.flag("--list", options->list, "Only the names of the profiles.");
  command.flag("--reference", options->reference, "Every setting with its bounds, as Markdown.");
  command.footer("Example: swiftlet config --system swiftlet > mine.yaml");
  command.runs([options] {
    if (options->reference) {
      fmt::print("{}", reference());
    } else if (options->list) {
      for (const std::string& name : flight::systemNames()) fmt::print("{}\n", common::printable(name));
    } else {
      fmt::print("{}", flight::loadSystem(options->system).toYaml(!options->plain));
    }
    return kDone;
  });
}

}  // namespace swiftlet::apps
