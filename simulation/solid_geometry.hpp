// Triangles of SDF geometry other than meshes.
#pragma once

#include <string>

#include <sdf/Geometry.hh>
#include <tl/expected.hpp>

#include "common/message.hpp"
#include "simulation/triangulate.hpp"
#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {

/// A collision plane is infinite in SDF; it gets at least this side.
inline constexpr double kEndlessPlane_m = 200.0;

/// Boxes, cylinders, spheres, capsules, ellipsoids, cones, planes with a side of `least_plane_m` or more, polylines and
/// heightmaps. The error is about the geometry: a kind that is not known, a size that no thing has, a picture of
/// heights that cannot be read. Pictures are searched for by `resolver`, from the file of the geometry.
tl::expected<Triangles, common::Message> solidTriangles(const sdf::Geometry& geometry, double least_plane_m,
                                                        const UriResolver& resolver);

}  // namespace swiftlet::simulation
