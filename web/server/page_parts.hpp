// The world encoded for the pages, once for all of them, in parts that change at different rates. Each part is encoded
// again only when its layer of the world is another one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "web/server/submap_feed.hpp"
#include "web/server/tile_feed.hpp"
#include "web/server/tree_feed.hpp"

namespace swiftlet::common {
struct MapLayer;
struct World;
}  // namespace swiftlet::common

namespace swiftlet::web {

/// A text for the pages with a number that rises when it changes.
struct Part {
  SharedText text;
  std::uint64_t version = 0;

  void set(std::string next) {
    if (text && *text == next) return;
    text = std::make_shared<const std::string>(std::move(next));
    ++version;
  }
};

/// One thread. Every text is null before the first world.
class PageParts {
 public:
  /// Updates all parts but the submaps.
  void update(const std::shared_ptr<const common::World>& world);
  /// Updates the submaps; nothing without a 3D map.
  void updateMap3d(const common::World& world);

  const Part& frontiers() const { return frontiers_; }
  const Part& levels() const { return levels_; }
  /// The map of this flight alone.
  const TileFeed& tiles() const { return tiles_; }
  /// The given map, in its own cells; empty without one.
  const TileFeed& givenTiles() const { return given_tiles_; }
  const Part& givenMap() const { return given_map_; }
  const TreeFeed& tree() const { return tree_; }
  const SubmapFeed& submaps() const { return submaps_; }
  /// Little endian: u8 2, u8 0, u16 number of points, then i16 x, i16 y in centimetres; null: no scan.
  const Part& laser() const { return laser_; }
  /// Rises if earlier points of the trail have moved.
  std::uint64_t trailVersion() const { return trail_version_; }

 private:
  void encodeMap(const common::MapLayer& map, const common::MapLayer* last);

  std::shared_ptr<const common::World> encoded_;  ///< The last world; kept alive, so that its layers can be compared.
  Part frontiers_, levels_, laser_, given_map_;
  TileFeed tiles_, given_tiles_;
  TreeFeed tree_;
  SubmapFeed submaps_;
  std::uint64_t trail_version_ = 1;
};

}  // namespace swiftlet::web
