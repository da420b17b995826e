// The 3D map for pages that draw it themselves: each point of a submap is sent once, when it is new. Where the submaps
// are is sent apart, so that a loop closure costs poses only.
//
// A submap is sent as two lists: one with an even number that grows at its end, and after it one of its noisy points
// (those of large cubes). These come and go as their surfaces are seen better, so that the second list is replaced.
//
// Messages, little endian; the lists of the submap i, counted from 0, have the numbers 2 i and 2 i + 1:
//   points  u8 3, u8 added, u16 list, u32 version, u32 number of the first point, u32 points of the list, f32 step,
//           then for each point of this part: i16 x, y, z, i8 nx, ny, nz, u8 r, g, b. A position in the submap's frame
//           is step * (x, y, z) in metres, a normal is in units of 1/127, zero if not known. `added` is 1 where the
//           points follow those that the page has of this list. Where it is 0 they replace them, once all parts of
//           this version have come.
//   poses   u8 4, u8 0, u16 number of lists, u32 version, then for each f32 x, y, z, qx, qy, qz, qw of
//           T_map_submap. A list with a higher number than these is no longer part of the map.
//   camera  u8 5, u8 tracked, u16 0, f32 x, y, z, qx, qy, qz, qw of T_map_camera, f32 tangents of half the field of
//           view, across and up.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/submap3d.hpp"
#include "common/time.hpp"
#include "web/server/tile_feed.hpp"

namespace swiftlet::common {
struct Map3dLayer;
}

namespace swiftlet::web {

/// What all pages share. One thread.
class SubmapFeed {
 public:
  using Points = std::shared_ptr<const std::vector<common::SurfacePoint>>;

  struct List {
    Points all;  ///< The points of the submap; kept, so that its address stays unique.
    std::span<const common::SurfacePoint> points;
    std::uint32_t version = 0;  ///< Rises when the points change; never 0.
    /// The version that began the present list of points. Since then points were added behind it, and those before have
    /// moved by no more than averaging moves them.
    std::uint32_t lineage = 0;
    float reach_m = 0.0F;  ///< The greatest coordinate.
  };

  /// Looks at points that are new only.
  void update(const common::Map3dLayer& map3d);

  /// Two for each submap.
  const std::vector<List>& lists() const { return lists_; }
  /// Null before the first update; another object for other poses.
  const SharedText& poses() const { return poses_; }
  /// Null as long as there is no frame.
  const SharedText& camera() const { return camera_; }

 private:
  void takePoints(List& known, const Points& all, std::span<const common::SurfacePoint> points);
  void takeNoisy(List& known, const Points& all, std::span<const common::SurfacePoint> points);

  std::uint32_t last_version_ = 0;
  std::vector<List> lists_;
  std::uint32_t poses_version_ = 0;
  std::string pose_bytes_;
  SharedText poses_, camera_;
};

/// The lists of one page. New points come at once, those of the newest submap first. The points of a submap that has
/// settled are sent once more when they have moved since, and so are those of one that was thinned; that takes at most
/// kRefreshBytesPerSecond. The noisy points of the newest submap are sent again every 2 s at most.
class SubmapReader {
 public:
  static constexpr double kRefreshBytesPerSecond = 200e3;

  /// The next messages, of about `most_bytes` or one message; empty when the page has everything it may have.
  std::vector<SharedText> next(const SubmapFeed& feed, common::Time now, std::size_t most_bytes);

 private:
  /// Of the points of a list.
  struct Has {
    std::uint32_t lineage = 0;
    std::uint32_t version = 0;  ///< When the first of them was sent.
    std::size_t points = 0;
  };
  /// Keeps the points alive until they are sent, although the submap may have changed.
  struct Transfer {
    SubmapFeed::List list;
    std::size_t number = 0;
    std::size_t sent = 0;
    bool added = false;
  };

  std::optional<Transfer> choose(const SubmapFeed& feed, common::Time now);
  SharedText nextPart();

  std::vector<Has> has_;
  SharedText poses_, camera_;
  std::optional<Transfer> transfer_;
  common::Time asked_;          ///< The last time that next() was called.
  common::Time refresh_;        ///< From then on points may be sent again.
  common::Time refresh_noisy_;  ///< And noisy ones of the newest submap.
};

}  // namespace swiftlet::web
