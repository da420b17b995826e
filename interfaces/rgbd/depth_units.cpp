#include "interfaces/rgbd/depth_units.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <set>

#include <fmt/core.h>

namespace swiftlet::interfaces {
namespace {

/// What is stored a metre: by ROS (REP 118), Open3D, ScanNet and 7-Scenes, and by TUM RGB-D.
constexpr double kMillimetres = 1000.0, kTumUnits = 5000.0;
/// Nine of ten depths of a room are between these: structured light and stereo begin at 0.3 m, and depths beyond 10 m
/// are rare in buildings.
constexpr double kNearest_m = 0.3, kFarthest_m = 10.0;
/// Fewer different codes say nothing of their steps.
constexpr std::size_t kLeastDifferent = 50;
/// 7-Scenes marks invalid depth so.
constexpr std::uint16_t kInvalid = 65535;

struct CodeRange {
  double low = 0.0, median = 0.0, high = 0.0;  ///< A tenth of the codes is below the first and above the last.

  bool isPlausible(double per_m) const { return low / per_m >= kNearest_m && high / per_m <= kFarthest_m; }
};

CodeRange codeRangeOf(std::vector<std::uint16_t>& codes) {
  std::sort(codes.begin(), codes.end());
  const auto at = [&](std::size_t tenths) { return static_cast<double>(codes[tenths * (codes.size() - 1) / 10]); };
  return {at(1), at(5), at(9)};
}

bool areFives(const std::vector<std::uint16_t>& codes) {
  std::set<std::uint16_t> different;
  for (const std::uint16_t code : codes) {
    if (code % 5 != 0) return false;
    if (different.size() < kLeastDifferent) different.insert(code);
  }
  return different.size() >= kLeastDifferent;
}

}  // namespace

DepthUnits depthUnitsOf(const std::vector<std::uint16_t>& all, double usual_per_m) {
  std::vector<std::uint16_t> codes;
  std::copy_if(all.begin(), all.end(), std::back_inserter(codes),
               [](std::uint16_t code) { return code != 0 && code != kInvalid; });
  if (codes.empty()) return {usual_per_m, ""};
  const CodeRange range = codeRangeOf(codes);
  const double other_per_m = usual_per_m == kMillimetres ? kTumUnits : kMillimetres;
  const bool fives = areFives(codes);
  const bool must_be_tum = fives && range.isPlausible(kTumUnits);
  const bool usual = must_be_tum ? usual_per_m == kTumUnits : range.isPlausible(usual_per_m);
  const bool other = must_be_tum ? usual_per_m != kTumUnits : range.isPlausible(other_per_m);
  const auto depths = [&](double per_m) { return fmt::format("{:.2g} m in the median", range.median / per_m); };
  if (!usual && other)
    return {other_per_m,
            fmt::format("the depths are taken for {:g} units a metre, {}: with the usual {:g} they would be "
                        "{} (depth_units_per_m in --intrinsics)",
                        other_per_m, depths(other_per_m), usual_per_m, depths(usual_per_m))};
  if (usual && other)
    return {usual_per_m,
            fmt::format("the depths are {}, at the usual {:g} units a metre; at {:g}, which is possible too, "
                        "they would be {} (depth_units_per_m in --intrinsics)",
                        depths(usual_per_m), usual_per_m, other_per_m, depths(other_per_m))};
  return {usual_per_m, ""};
}

}  // namespace swiftlet::interfaces
