// links: interfaces common
// Any bytes as a map: what stands before the first "P" at the beginning of a line is map.yaml, the rest its picture.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/files/map_server.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t picture = bytes.starts_with('P') ? 0 : bytes.find("\nP") + 1;  // 0 as well when there is none.
  const std::string yaml = fuzz::put("map.yaml", bytes.substr(0, picture));
  fuzz::put("map.pgm", bytes.substr(picture));
  try {
    const interfaces::StoredMap map = interfaces::readMap(yaml);
    if (!map.T_map_grid.position_m().allFinite()) std::abort();
    (void)interfaces::toPgm(map.grid);
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  try {
    const interfaces::GreyImage image = interfaces::parsePgm(bytes.substr(picture), "map.pgm");
    if (image.pixels.size() != static_cast<std::size_t>(image.width_px) * image.height_px) std::abort();
  } catch (const common::InputError&) {}
  return 0;
}
