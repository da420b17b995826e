#include "apps/cloud_unit.hpp"

#include <fmt/core.h>
#include <Eigen/Geometry>

namespace swiftlet::apps {
namespace {

/// Hardly a building is as high or long as these, but a room in inches or centimetres is higher, and one in
/// millimetres is longer.
constexpr float kTallest_m = 60.0F, kLongest_m = 500.0F;
/// A building in degrees is less wide than the first, which is 11 km, and with a height in metres higher than the
/// second.
constexpr float kWidest_deg = 0.1F, kLowest_m = 1.0F;

/// Within a tenth of a degree, and not where the equator meets the prime meridian.
bool looksLikeDegrees(const Eigen::AlignedBox3f& box) {
  const Eigen::Vector2f extent = box.sizes().head<2>();
  const Eigen::Vector2f farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).head<2>();
  return extent.minCoeff() > 0.0F && extent.maxCoeff() < kWidest_deg && box.sizes().z() > kLowest_m &&
         farthest.maxCoeff() <= 180.0F && farthest.minCoeff() <= 90.0F && farthest.maxCoeff() > 1.0F;
}

bool saysOtherUnit(const interfaces::StoredCloud& cloud) { return cloud.unit && cloud.unit->metres != 1.0; }

}  // namespace

std::string headerUnitNote(const std::string& file, const interfaces::StoredCloud& cloud) {
  if (!saysOtherUnit(cloud)) return "";
  return fmt::format("{}:{}: its header says {}: give --scale {:g}", file, cloud.unit_line, cloud.unit->word,
                     cloud.unit->metres);
}

std::string extentNote(const interfaces::StoredCloud& cloud) {
  if (cloud.points.empty() || saysOtherUnit(cloud)) return "";
  Eigen::AlignedBox3f box;
  for (const common::SurfacePoint& point : cloud.points) box.extend(point.position_m);
  if (looksLikeDegrees(box))
    return "the points look like longitude and latitude in degrees: project them to metres first";
  const float height_m = box.sizes().z(), length_m = box.sizes().head<2>().maxCoeff();
  if (height_m > kTallest_m) return fmt::format("the points reach over {:.0f} m of height: {}", height_m, kUnitHint);
  if (length_m > kLongest_m) return fmt::format("the points reach over {:.0f} m: {}", length_m, kUnitHint);
  return "";
}

std::vector<std::string> mapNotes(const std::string& file, const interfaces::StoredCloud& cloud, bool has_scale) {
  std::vector<std::string> notes = cloud.notes;
  if (has_scale) return notes;
  for (const std::string& note : {headerUnitNote(file, cloud), extentNote(cloud)})
    if (!note.empty()) notes.push_back(note);
  return notes;
}

}  // namespace swiftlet::apps
