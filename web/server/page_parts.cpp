#include "web/server/page_parts.hpp"

#include <cmath>

#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "web/server/state_json.hpp"

namespace swiftlet::web {
namespace {

/// Denser end points of a scan are not sent: they fall on one pixel of the page.
constexpr double kLaserSpacing_m = 0.04;

/// The scan, thinned for the page.
std::string laserBytes(const common::LaserPoints& laser) {
  std::string bytes(4, '\0');
  Eigen::Vector2f last = Eigen::Vector2f::Constant(1e9f);
  std::size_t count = 0;
  for (const Eigen::Vector2f& p : laser.points_map_m) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 320.0f || (p - last).norm() < kLaserSpacing_m) continue;
    last = p;
    for (const float coordinate : {p.x(), p.y()}) {
      const auto cm = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(100.0f * coordinate)));
      bytes += static_cast<char>(cm & 255);
      bytes += static_cast<char>(cm >> 8);
    }
    if (++count == 2000) break;
  }
  bytes[0] = 2;
  bytes[2] = static_cast<char>(count & 255);
  bytes[3] = static_cast<char>(count >> 8);
  return bytes;
}

}  // namespace

void PageParts::update(const std::shared_ptr<const common::World>& world) {
  if (world == encoded_) return;
  encodeMap(*world->map, encoded_ ? encoded_->map.get() : nullptr);
  if (!encoded_ || encoded_->mission != world->mission) tree_.update(world->mission->status.tree);
  const common::VehicleLayer& vehicle = *world->vehicle;
  if (vehicle.laser && (!encoded_ || encoded_->vehicle->laser != vehicle.laser)) laser_.set(laserBytes(*vehicle.laser));
  if (encoded_ && !vehicle.trail.continues(encoded_->vehicle->trail)) ++trail_version_;
  encoded_ = world;
}

void PageParts::encodeMap(const common::MapLayer& map, const common::MapLayer* last) {
  if (!last || last->frontiers != map.frontiers)
    frontiers_.set(frontiersJson(*map.frontiers, map.grid->resolution_m()));
  if (!last || last->levels != map.levels) levels_.set(levelsJson(*map.levels));
  tiles_.update(map.flown);
  if (!last || last->given != map.given) given_map_.set(givenMapJson(map.given.get()));
  if (map.given) given_tiles_.update(map.given->grid);
}

void PageParts::updateMap3d(const common::World& world) {
  if (world.map3d) submaps_.update(*world.map3d);
}

}  // namespace swiftlet::web
