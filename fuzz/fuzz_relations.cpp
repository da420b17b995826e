// links: interfaces common
// Any bytes as relations, as reference poses and as pose matrices: refused as InputError, or finite, with rotations of
// length one.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/refused_or.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/files/trajectory_file.hpp"

namespace {

void check(const swiftlet::common::Pose3& pose) {
  if (!isFinite(pose) || std::abs(pose.rotation.norm() - 1.0) > 1e-6) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::refusedOr([&] {
    for (const common::Relation& relation : interfaces::parseRelations(text, "fuzz.relations"))
      check(relation.T_from_to);
  });
  fuzz::refusedOr([&] {
    for (const common::StampedPose& pose : interfaces::parseReferencePoses(text, "fuzz.txt")) check(pose.pose);
  });
  fuzz::refusedOr([&] {
    for (const common::StampedPose& pose : interfaces::parsePoseMatrices(text, "fuzz.txt").poses) check(pose.pose);
  });
  return 0;
}
