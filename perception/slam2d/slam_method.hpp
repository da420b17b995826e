// Which method of 2D SLAM does the work, chosen by a profile, and the settings of each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "perception/slam2d/particle_slam.hpp"
#include "perception/slam2d/planar_slam.hpp"
#include "perception/slam2d/scan_to_map_slam.hpp"
#include "perception/slam2d/slam_config.hpp"

namespace swiftlet::perception {

/// The settings of the graph, the default, stand beside `method`; those of the others in sections of their own. Only
/// those of the chosen method have an effect, but for `grid`, which is that of every method's map.
struct SlamMethodConfig : Slam2dConfig {
  SlamMethod method = SlamMethod::kGraph;
  ParticleSlamConfig particles;
  ScanToMapConfig scan_to_map;

  void describe(common::config::Fields& fields);
};

/// Names of the methods in profiles and on the command line, in the order of SlamMethod.
const std::vector<std::string>& slamMethodNames();

/// The method of that name, which must be one of slamMethodNames().
SlamMethod slamMethodOf(const std::string& name);

/// Never null.
std::unique_ptr<PlanarSlam> makeSlam(const SlamMethodConfig& config);

}  // namespace swiftlet::perception
