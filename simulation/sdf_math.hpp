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

inline Eigen::Vector3d toEigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

inline common::Pose3 toPose(const ignition::math::Pose3d& pose) {
  return {Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()).normalized(),
          toEigen(pose.Pos())};
}

/// Of an element that is not from a file, `file`.
inline common::SourceLocation locationOf(const sdf::ElementPtr& element, const std::string& file) {
  if (!element) return {file};
  return {element->FilePath().empty() ? file : element->FilePath(), element->LineNumber().value_or(0)};
}

}  // namespace swiftlet::simulation
