// The chimney in the picture, which tells one end of a house from the other and where it stands along its roof (Tomic
// 2012, section "Recognition": "parts of the house (e.g., chimney) are identified in a monocular image of the stereo
// pair and fused with results of the point cloud fitting").
//
// A chimney is something of another brightness than what is around it. Its outline is predicted from the pose and moved
// over the roof; the correlation of the picture with it, inside against outside, is the greatest where the chimney is.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "perception/recognition/house_fit.hpp"
#include "perception/recognition/house_model.hpp"
#include "perception/recognition/recognizer.hpp"
#include "perception/recognition/wall_planes.hpp"

namespace swiftlet::perception {

struct ChimneyMatch {
  double correlation = 0.0;  ///< In [0, 1], with the sign left out: it may be brighter or darker than the roof.
  double in_depth = 0.0;     ///< Share of its pixels with a depth that are where it is, and not on the roof.
  Eigen::Vector2d moved_m = Eigen::Vector2d::Zero();  ///< Along x and y of the house, from where the pose has it.
  double sigma_m = 0.0;                               ///< Of each.

  double evidence() const { return correlation + in_depth; }
};

/// nullopt where the picture does not show the place of the chimney whole.
std::optional<ChimneyMatch> findChimney(const HousePose& pose, const HouseModel& model, const CameraPicture& picture,
                                        const DepthView& view);

/// The pose turned so that the chimney is where the picture has it, with its place fused; nullopt where the picture
/// does not tell the ends apart.
struct HouseWithChimney {
  HousePose pose;
  double sure = 0.0;  ///< In (0, 1].
};
std::optional<HouseWithChimney> fusedWithChimney(const HousePose& pose, const HouseModel& model,
                                                 const CameraPicture& picture, const DepthView& view);

}  // namespace swiftlet::perception
