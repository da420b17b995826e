// links: common
// Any bytes as a topological map: refused as InputError, or sound enough to be written and read back.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/topological_map.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  common::TopologicalMap map;
  try {
    common::config::YamlReader::fromText({reinterpret_cast<const char*>(data), size}, "fuzz.yaml").read(map);
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
    return 0;
  }
  for (const common::MapPlace& place : map.places)
    if (place.name.empty() || !std::isfinite(place.x_m) || !std::isfinite(place.y_m)) std::abort();
  for (const common::DangerZone& zone : map.danger_zones)
    if (zone.corners_m.size() < 6) std::abort();
  const std::string written = common::toYaml(map);
  common::TopologicalMap again;
  common::config::YamlReader::fromText(written, "written").read(again);
  if (common::toYaml(again) != written) std::abort();
  return 0;
}
