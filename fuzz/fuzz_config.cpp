// links: common
// Any bytes as a data sheet: refused as InputError, or read, and then what is printed of it is read back to the same.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/vehicle_config.hpp"

namespace {

using namespace swiftlet::common;

template <typename Config>
void readAndPrint(const std::string& text) {
  const auto print = [](const Config& config) {
    return config::YamlPrinter(config::YamlPrinter::Comments::kNo).print(config);
  };
  Config config;
  try {
    config::YamlReader::fromText(text, "fuzz.yaml").read(config);
  } catch (const InputError& error) {
    if (error.problems().empty() || std::string(error.what()).empty()) std::abort();
    return;
  }
  const std::string printed = print(config);
  Config again;
  config::YamlReader::fromText(printed, "printed").read(again);
  if (print(again) != printed) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  readAndPrint<VehicleConfig>(text);
  readAndPrint<LaserConfig>(text);
  return 0;
}
