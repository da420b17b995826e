// What a depth camera would see of the volume that nobody has seen yet, from the places that the vehicle can reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/voxel_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// A place and a heading to look from with the camera.
struct CameraLook {
  common::CellIndex place;
  double path_m = 0.0;  ///< Cost of the path from the vehicle, in metres of open space.
  double yaw_map_rad = 0.0;
  double gain_m3 = 0.0;  ///< Unknown volume expected to be seen.
};

/// Of one call of an explorer; refers to its arguments, which must outlive it. What counts are cubes of 0.2 m of which
/// nothing is known, over floor that the laser knows to be free: behind a wall, or beyond what the laser has seen, no
/// volume is expected. Rays end at occupied voxels. Not thread-safe.
class VolumeSurvey {
 public:
  /// A view of less volume is not worth a look.
  static constexpr double kMinGain_m3 = 0.06;

  /// `input.volume.voxels` is not null. `field` was spread over the whole map.
  VolumeSurvey(const ExplorationInput& input, const CostMap& map, const CostField& field, const CameraFrustum& frustum);

  /// The current viewpoint with what is left to be seen from it; nullopt if that is too little, if it is none of the
  /// camera, or out of reach.
  std::optional<CameraLook> current() const { return current_; }
  /// Looks that together see the volume that can be seen, again and again the one that sees most of what is left; the
  /// current one first, if there is one. Of places far away only as many as a tour needs.
  std::vector<CameraLook> cover(std::size_t most);

 private:
  /// Directions around a place, every 4 degrees, and rays from the lower to the upper edge of the picture.
  static constexpr int kColumns = 90, kRows = 12;
  /// Unknown cubes, by their numbers, that are seen in each direction.
  using Column = std::vector<std::uint32_t>;
  struct Panorama {
    common::CellIndex place;
    double path_m = 0.0;
    std::array<Column, kColumns> columns;
  };

  void writeOffAttempts();
  std::optional<CameraLook> lookAgain(const Viewpoint& viewpoint);
  std::vector<Panorama> panoramas(std::size_t most);
  Panorama pictureAt(const Eigen::Vector2d& place_map_m, double yaw_map_rad);
  Column columnAt(const Eigen::Vector2d& place_map_m, int column);
  void castRay(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& direction, double range_m, Column& seen);
  std::optional<std::uint32_t> numberOf(const common::VoxelIndex& cube);
  CameraLook bestLook(const Panorama& panorama);
  double gainOf_m3(const Panorama& panorama, double yaw_map_rad);
  void mark(const Panorama& panorama, double yaw_map_rad);

  const ExplorationInput& input_;
  const CostMap& map_;
  const CostField& field_;
  CameraFrustum frustum_;
  int half_columns_ = 0;  ///< Of a picture.
  std::unordered_map<common::VoxelIndex, std::uint32_t, common::VoxelMap::Hash> numbers_;
  std::vector<bool> is_covered_;           ///< Of each unknown cube.
  std::vector<std::uint32_t> counted_in_;  ///< The last count that it was part of.
  std::uint32_t counts_ = 0;
  std::optional<CameraLook> current_;
};

}  // namespace swiftlet::planning
