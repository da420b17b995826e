// Numbers and places of libsdformat in our types.
#pragma once

#include <string>

#include <Eigen/Core>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <sdf/Element.hh>

#include "common/error.hpp"
#include "common/geometry.hpp"

namespace swiftlet::simulation {

Eigen::Vector3d toEigen(const ignition::math::Vector3d& v);
common::Pose3 toPose(const ignition::math::Pose3d& pose);
/// Of an element that is not from a file, `file`.
common::SourceLocation locationOf(const sdf::ElementPtr& element, const std::string& file);

}  // namespace swiftlet::simulation
