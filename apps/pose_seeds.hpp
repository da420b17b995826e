// Poses of a camera from other sensors, to begin the alignment of a frame with.
#pragma once

#include <optional>
#include <string>

#include "common/trajectory.hpp"

namespace swiftlet::apps {

class PoseSeeds {
 public:
  /// A trajectory of TUM's format. Throws InputError.
  explicit PoseSeeds(const std::string& file);

  /// Between two poses at most 0.5 s apart; none elsewhere.
  std::optional<common::Pose3> at(common::Time stamp) const;

 private:
  common::Trajectory poses_;
};

}  // namespace swiftlet::apps
