// The 3D map for pages that draw it themselves: the points of each submap are encoded and sent once, and again only
// when the submap has grown. Where the submaps are is sent apart, so that a loop closure costs poses only.
//
// Messages, little endian; submaps are counted from 0:
//   points  u8 3, u8 0, u16 submap, u32 version, u32 number of the first point, u32 points of the submap,
//           f32 x, y, z, f32 step, then for each point of this part: u16 x, y, z, i8 nx, ny, nz, u8 r, g, b.
//           A position in the submap's frame is (x, y, z) + step * (u16 x, y, z) in metres. A normal is in units of
//           1/127, zero if not known. All parts of a version come one after the other.
//   poses   u8 4, u8 0, u16 number of submaps, u32 version, then for each f32 x, y, z, qx, qy, qz, qw of
//           T_map_submap. A submap with a higher number than these is no longer part of the map.
//   camera  u8 5, u8 tracked, u16 0, f32 x, y, z, qx, qy, qz, qw of T_map_camera, f32 tangents of half the field of
//           view, across and up.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/world/map3d_layer.hpp"
#include "web/server/tile_feed.hpp"

namespace swiftlet::web {

/// What all pages share. One thread.
class SubmapFeed {
 public:
  using Points = std::shared_ptr<const std::vector<common::SurfacePoint>>;

  struct Entry {
    Points points;
    std::uint32_t version = 0;      ///< Rises when the points change; never 0.
    std::vector<SharedText> parts;  ///< Empty before encoded() made them.
  };

  /// Cheap if little has changed. Encodes no points.
  void update(const common::Map3dLayer& map3d);

  std::size_t size() const { return entries_.size(); }
  std::uint32_t version(std::size_t submap) const { return entries_[submap].version; }
  /// The messages of a submap, encoded when they are first asked for.
  const std::vector<SharedText>& encoded(std::size_t submap) const;
  /// Null before the first update; another object for other poses.
  const SharedText& poses() const { return poses_; }
  /// Null as long as there is no frame.
  const SharedText& camera() const { return camera_; }

 private:
  std::uint32_t last_version_ = 0;
  mutable std::vector<Entry> entries_;
  std::uint32_t poses_version_ = 0;
  std::string pose_bytes_;
  SharedText poses_, camera_;
};

/// What one page has. Submaps that it has not yet come first, the newest of them at once. Changed ones are sent again
/// so seldom that they take at most kRefreshBytesPerSecond, however often they change.
class SubmapReader {
 public:
  static constexpr double kRefreshBytesPerSecond = 200e3;

  /// The next messages, of about `most_bytes` or one message; empty when the page has everything it may have.
  std::vector<SharedText> next(const SubmapFeed& feed, common::Time now, std::size_t most_bytes);

 private:
  /// The submap to send next.
  std::optional<std::size_t> choose(const SubmapFeed& feed, common::Time now) const;
  bool begin(const SubmapFeed& feed, common::Time now);

  std::vector<std::uint32_t> versions_;  ///< Of the submaps that it has; 0: none.
  common::Time refresh_;                 ///< From then on a changed submap may be sent.
  SharedText poses_, camera_;
  std::vector<SharedText> sending_;  ///< Parts that have not been sent, in reverse.
};

}  // namespace swiftlet::web
