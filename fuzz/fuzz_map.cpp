// links: interfaces common
// Any bytes as a map: what stands before the first line that begins as a picture does is map.yaml, the rest its
// picture.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/files/map_picture.hpp"
#include "interfaces/files/map_server.hpp"

namespace {

/// 0 as well when there is no picture.
std::size_t pictureBegin(const std::string& bytes) {
  std::size_t begin = std::string::npos;
  for (const char* magic : {"P", "BM", "\x89PNG", "\xff\xd8\xff"}) {
    if (bytes.starts_with(magic)) return 0;
    begin = std::min(begin, bytes.find(std::string("\n") + magic));
  }
  return begin == std::string::npos ? 0 : begin + 1;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t picture = pictureBegin(bytes);
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
    const common::GreyImage image = interfaces::parsePicture(bytes.substr(picture), "map.pgm").image;
    const std::size_t pixels = static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
    if (image.brightness.size() != pixels) std::abort();
    if (!image.opacity.empty() && image.opacity.size() != pixels) std::abort();
  } catch (const common::InputError&) {}
  return 0;
}
