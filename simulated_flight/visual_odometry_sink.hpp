// Tracks the RGB-D camera of a flight without laser, inertial unit and height, beside the vehicle's own estimate: what
// visual odometry alone would have known. Its loops are closed and its pose graph is optimized, because the map of the
// paper's figure is (Saeedi, Fig. 1, top: "optimized using a bundle adjustment algorithm", g2o).
#pragma once

#include <vector>

#include "autonomy/loop/flight_sink.hpp"
#include "evaluation/estimate_record.hpp"
#include "mapping3d/model/mapper3d.hpp"

namespace swiftlet::simulated_flight {

/// One thread. Every frame is tracked in the loop's thread, so that the flight takes longer on the wall clock.
class VisualOdometrySink final : public autonomy::FlightSink {
 public:
  /// `T_body_camera` as the camera's data sheet has it.
  VisualOdometrySink(const mapping3d::Mapper3dConfig& config, const common::Pose3& T_body_camera)
      : mapper_(config), T_camera_body_(T_body_camera.inverse()) {}

  void input(const autonomy::Input& input) override;
  /// With all loop closures so far.
  evaluation::VisualOdometryRecord record() const;

 private:
  struct Tracked {
    common::Time stamp;
    int scan = 0;  ///< The key frame that later loop closures move it with.
    common::Pose3 T_scan_camera;
  };

  mapping3d::Mapper3d mapper_;
  common::Pose3 T_camera_body_;
  std::vector<Tracked> tracked_;
  std::size_t frames_ = 0;
};

}  // namespace swiftlet::simulated_flight
