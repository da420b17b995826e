#include "apps/map3d_trust.hpp"

#include <fmt/format.h>

#include "apps/recorded_log.hpp"

namespace swiftlet::apps {
namespace {

/// A map of which more than this part is missing is probably not one map.
constexpr double kMostMissing = 0.1;
/// Part of the surfaces seen again that may lie where another part of the map has free space
/// (docs/decisions/mapping3d.md#103).
constexpr double kMostContradiction = 0.05;

std::string whyMissing(const Map3dRun& run, std::size_t in_map, std::size_t pieces) {
  const std::size_t missing = run.frames - in_map;
  if (static_cast<double>(missing) <= kMostMissing * static_cast<double>(run.frames)) return "";
  std::string why = fmt::format("of {} {} lost", plural(run.frames, "frame", "frames"), run.lost);
  if (pieces > 1)
    why += fmt::format(", and {} in {} that nothing connects to the map", run.tracked.size() - in_map,
                       plural(pieces - 1, "piece", "pieces"));
  return why;
}

}  // namespace

Map3dTrust map3dTrust(Map3dRun& run, const std::vector<MapPiece>& pieces) {
  Map3dTrust trust;
  trust.reason = whyMissing(run, pieces.empty() ? 0 : pieces.front().frames.size(), pieces.size());
  trust.is_much_missing = !trust.reason.empty();
  if (pieces.empty()) return trust;
  trust.contradiction = mapping3d::contradictionOf(run.submapsOf(pieces.front()), *run.mapper.scans());
  if (!trust.reason.empty()) return trust;
  if (const auto factor = run.mapper.betterFocalFactor())
    trust.reason = fmt::format(
        "the frames fit each other better with {:.2f} times the focal length; check the calibration (--intrinsics)",
        *factor);
  else if (trust.contradiction.share() > kMostContradiction)
    trust.reason = fmt::format(
        "the map contradicts itself: of the surfaces that were seen twice, {:.0f} % lie in free space of the other "
        "view",
        100.0 * trust.contradiction.share());
  return trust;
}

}  // namespace swiftlet::apps
