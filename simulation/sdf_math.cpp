#include "simulation/sdf_math.hpp"

namespace swiftlet::simulation {

Eigen::Vector3d toEigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

common::Pose3 toPose(const ignition::math::Pose3d& pose) {
  return {Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()).normalized(),
          toEigen(pose.Pos())};
}

common::SourceLocation locationOf(const sdf::ElementPtr& element, const std::string& file) {
  if (!element) return {file};
  return {element->FilePath().empty() ? file : element->FilePath(), element->LineNumber().value_or(0)};
}

}  // namespace swiftlet::simulation
