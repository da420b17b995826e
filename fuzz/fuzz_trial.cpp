// links: evaluation simulation common
// Any bytes as a trial: refused as InputError, or sound enough to be printed and read back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/config.hpp"
#include "common/error.hpp"
#include "evaluation/trial.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  using common::config::YamlPrinter;
  evaluation::TrialConfig trial;
  try {
    common::config::YamlReader::fromText({reinterpret_cast<const char*>(data), size}, "fuzz.yaml").read(trial);
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
    return 0;
  }
  if (trial.repeat < 1 || trial.scenario.seed < 0 || trial.name.find('/') != std::string::npos) std::abort();
  const std::string printed = YamlPrinter(YamlPrinter::Comments::kNo).print(trial);
  evaluation::TrialConfig again;
  common::config::YamlReader::fromText(printed, "printed").read(again);
  if (YamlPrinter(YamlPrinter::Comments::kNo).print(again) != printed) std::abort();
  return 0;
}
