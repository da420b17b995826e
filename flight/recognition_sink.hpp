// What the run keeps of what was recognized: a picture of each object at its best look, with its outline drawn in, and
// the topological map.
#pragma once

#include <map>
#include <memory>

#include "autonomy/loop/flight_sink.hpp"
#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/topological_map.hpp"

namespace swiftlet::interfaces {
class RunFolder;
}

namespace swiftlet::common {
struct RecognizedObject;
struct World;
}  // namespace swiftlet::common

namespace swiftlet::flight {

/// Refers to the folder, which must outlive it.
class RecognitionSink final : public autonomy::FlightSink {
 public:
  /// `given` has the places that the mission could name; null without any.
  RecognitionSink(interfaces::RunFolder& folder, std::shared_ptr<const common::TopologicalMap> given)
      : folder_(folder), given_(std::move(given)) {}

  void world(const std::shared_ptr<const common::World>& world) override;
  /// Writes the pictures and the topological map of the end; once.
  void writeNow(const common::World& world);

 private:
  /// A frame that shows an object, and where it saw it.
  struct Look {
    std::shared_ptr<const common::RgbdFrame> frame;
    common::Pose3 T_camera_object;
    double size_px = 0.0;
  };

  interfaces::RunFolder& folder_;
  std::shared_ptr<const common::TopologicalMap> given_;
  std::map<int, Look> best_;  ///< By the id of the object.
};

}  // namespace swiftlet::flight
