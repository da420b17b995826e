// links: interfaces common
// Any bytes as a trajectory: refused as InputError, or finite poses in the order of time that are written and read
// back.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "interfaces/files/tum.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  common::Trajectory trajectory;
  try {
    trajectory = interfaces::parseTum({reinterpret_cast<const char*>(data), size}, "fuzz.tum");
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
    return 0;
  }
  std::string written;
  for (const common::StampedPose& pose : trajectory) {
    if (!pose.pose.position_m.allFinite() || !pose.pose.rotation.coeffs().allFinite()) std::abort();
    written += interfaces::toTumLine(pose);
  }
  const common::Trajectory again = interfaces::parseTum(written, "written");
  if (again.size() != trajectory.size()) std::abort();
  for (std::size_t i = 0; i < again.size(); ++i)
    if (again[i].stamp != trajectory[i].stamp) std::abort();
  return 0;
}
