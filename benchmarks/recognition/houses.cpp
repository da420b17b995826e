#include "benchmarks/recognition/houses.hpp"

#include <ctime>

#include <cstdio>
#include <numbers>
#include <vector>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/quantile.hpp"

namespace swiftlet::benchmarks {
namespace {

using perception::HouseLook;

/// A pose that is nearer is right.
constexpr double kRight_m = 0.15, kRight_deg = 3.0;

struct HouseCounts {
  int found = 0, right = 0, others_found = 0;
  std::vector<double> position_m, heading_deg, squared;
};

HouseCounts lookAtHouses(const HouseRun& run, HouseLook look, const common::RgbdCameraConfig& camera) {
  HouseCounts counts;
  for (std::uint64_t i = run.first; i < run.first + run.looks; ++i) {
    const auto known = perception::drawKnownHouse(run.houses, look, false, run.seed, i);
    const auto other = perception::drawKnownHouse(run.houses, look, true, run.seed, i);
    if (!perception::housesIn(other, camera).empty()) ++counts.others_found;
    const auto houses = perception::housesIn(known, camera);
    if (houses.empty()) continue;
    ++counts.found;
    const perception::HouseError error = perception::errorOf(houses.front(), known);
    const double heading_deg = error.heading_rad * 180.0 / std::numbers::pi;
    if (error.position_m < kRight_m && heading_deg < kRight_deg) ++counts.right;
    counts.position_m.push_back(error.position_m);
    counts.heading_deg.push_back(heading_deg);
    counts.squared.push_back(error.squared);
  }
  return counts;
}

void printHouses(const char* title, std::uint64_t looks, const HouseCounts& counts) {
  std::printf("\n| %s | |\n| --- | --- |\n", title);
  std::printf("| recognized, of %d looks | %d |\n", static_cast<int>(looks), counts.found);
  std::printf("| within 15 cm and 3 degrees | %d |\n", counts.right);
  std::printf("| of another size, taken for it | %d |\n", counts.others_found);
  if (counts.found == 0) return;
  const auto row = [](const char* name, const std::vector<double>& values) {
    std::printf("| %s, median / 95 %% / greatest | %.3f / %.3f / %.3f |\n", name, common::quantile(values, 0.5),
                common::quantile(values, 0.95), common::quantile(values, 1.0));
  };
  row("position, m", counts.position_m);
  row("heading, deg", counts.heading_deg);
  row("error squared over its covariance", counts.squared);
}

}  // namespace

void countHouses(const HouseRun& run) {
  const auto depths = perception::houseCamera();
  const auto stereo = common::config::readFile<common::RgbdCameraConfig>(
      common::findData("config/sensors/firefly_stereo.yaml").string());
  printHouses("depths, ahead and down", run.looks, lookAtHouses(run, HouseLook::kAhead, depths));
  printHouses("depths, down", run.looks, lookAtHouses(run, HouseLook::kDown, depths));
  printHouses("stereo, down", run.looks, lookAtHouses(run, HouseLook::kDown, stereo));
}

}  // namespace swiftlet::benchmarks
