// What `swiftlet map3d` keeps of the frames that it has mapped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/trajectory.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/recorded_seeds.hpp"
#include "rendering/thinned_curve.hpp"

namespace swiftlet::apps {

/// A frame relative to a key frame, so that later loop closures move it.
struct TrackedFrame {
  common::Time stamp;
  int scan = 0;
  common::Pose3 T_scan_camera;
};

/// The first tracked frame that has a given pose: it hangs the map into the world of the given poses.
struct WorldAnchor {
  std::size_t tracked = 0;  ///< Index of the frame among the tracked ones.
  common::Pose3 T_world_camera;
};

/// The frames of a piece of the map, in the order of their stamps.
struct MapPiece {
  int number = 0;  ///< See Mapper3d::pieceOf.
  std::vector<TrackedFrame> frames;
};

struct Map3dRun {
  explicit Map3dRun(const mapping3d::Mapper3dConfig& mapper_config) : config(mapper_config), mapper(config) {}

  mapping3d::Mapper3dConfig config;
  mapping3d::Mapper3d mapper;
  std::vector<TrackedFrame> tracked;
  std::optional<WorldAnchor> anchor;
  common::Trajectory given;  ///< Poses of the recorder's camera from other sensors.
  std::optional<mapping3d::SeedDisagreement> disagreement_of_given;
  std::uint64_t with_pose = 0;  ///< Frames with a given pose of their time.
  rendering::ThinnedCurve milliseconds, disagreement;
  std::vector<double> frame_ms;
  std::vector<double> depths_m;  ///< Median depths of some of the frames.
  std::uint64_t frames = 0, lost = 0, found_again = 0, key_frames = 0, loops = 0;
  std::uint64_t doubted = 0;  ///< Of the lost ones: frames just before a loss, whose poses nothing confirmed.
  std::size_t triangles = 0;  ///< Of the mesh; 0 if none was made.
  double wall_s = 0.0;

  /// The one with the most frames first, which is the map; of equal ones the older.
  std::vector<MapPiece> pieces() const {
    std::map<int, MapPiece> by_number;
    for (const TrackedFrame& frame : tracked) {
      MapPiece& piece = by_number[mapper.pieceOf(frame.scan)];
      piece.number = mapper.pieceOf(frame.scan);
      piece.frames.push_back(frame);
    }
    std::vector<MapPiece> pieces;
    for (auto& [number, piece] : by_number) pieces.push_back(std::move(piece));
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const MapPiece& a, const MapPiece& b) { return a.frames.size() > b.frames.size(); });
    return pieces;
  }

  std::vector<common::Submap3d> submapsOf(const MapPiece& piece) {
    std::vector<common::Submap3d> submaps = mapper.submaps();
    std::erase_if(submaps, [&](const auto& submap) { return mapper.pieceOf(submap.key) != piece.number; });
    return submaps;
  }

  double medianMs() const { return medianOf(frame_ms); }
  double medianDepth_m() const { return medianOf(depths_m); }

 private:
  /// 0 of an empty list.
  static double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
  }
};

}  // namespace swiftlet::apps
