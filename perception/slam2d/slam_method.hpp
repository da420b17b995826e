// The choice of the 2D SLAM method by a profile, and the settings of each method.
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

/// The settings of the graph, which is the default, are beside `method`. The other methods have sections of their own.
/// Only the settings of the chosen method have an effect, except `grid`: every method draws its map by it.
struct SlamMethodConfig : Slam2dConfig {
  SlamMethod method = SlamMethod::kGraph;
  ParticleSlamConfig particles;

  void describe(common::config::Fields& fields);
};

/// Names of the methods in profiles and on the command line, in the order of SlamMethod.
const std::vector<std::string>& slamMethodNames();

/// Each method's name and one sentence about it, for help texts: "graph: ... particles: ...".
std::string slamMethodHelp();

/// The method of that name, which must be one of slamMethodNames().
SlamMethod slamMethodOf(const std::string& name);

/// Creates the chosen method; never null.
std::unique_ptr<PlanarSlam> makeSlam(const SlamMethodConfig& config);

}  // namespace swiftlet::perception
