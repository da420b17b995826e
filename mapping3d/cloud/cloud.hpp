// The cloud of a 3D map: the points of all submaps in `map`, thinned, without specks. By the Point Cloud Library (PCL),
// whose headers only cloud.cpp includes.
#pragma once

#include <vector>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"

namespace swiftlet::mapping3d {

struct CloudConfig {
  /// One point is kept in a cube of this size: the mean of positions, normals and colours of all that fell into it. Of
  /// the noisy points of submaps one is kept in a cube of kLargeCube times this size, where there is no better one.
  double cube_m = 0.02;
  /// Greatest number of points: beyond, the cubes are enlarged until the cloud has no more.
  std::size_t points_max = 4'000'000;
  /// Statistical outlier removal (Rusu 2008): the mean distance of a point to this many nearest neighbours is compared
  /// with that of all points. On a plane with a point in each cube, 20 neighbours are within three cubes. At 0 neither
  /// outliers nor missing normals are looked for, which takes most of the time.
  int neighbours = 20;
  /// A point is an outlier where it is farther than the mean by this many standard deviations: the usual three. A noisy
  /// point, which has more distant neighbours, is one where it has hardly any.
  double deviations = 3.0;
};

/// Of the points of all submaps, each where its key scan is. Points that are not finite are left out. A normal that is
/// not known becomes that of the plane through its neighbours, on the side of their known normals; it stays unknown
/// where they have none. Equal arguments give equal bytes; one thread. Takes some seconds for a million points.
std::vector<common::SurfacePoint> cloudOf(const std::vector<common::Submap3d>& submaps, const common::KeyPoses& keys,
                                          const CloudConfig& config = {});

}  // namespace swiftlet::mapping3d
