// links: interfaces common
// Any bytes as a cloud, .ply if the first is even and .pcd otherwise: refused as InputError, or points that are written
// and read back as the same.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "interfaces/clouds/point_cloud.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  const auto format = data[0] % 2 == 0 ? interfaces::CloudFormat::kPly : interfaces::CloudFormat::kPcd;
  try {
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto points = interfaces::parseCloud(bytes, "fuzz", format).points;
    const auto again = interfaces::parseCloud(interfaces::toCloud(points, format), "written", format).points;
    if (again.size() != points.size()) std::abort();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (again[i].position_m != points[i].position_m || again[i].rgb != points[i].rgb) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
