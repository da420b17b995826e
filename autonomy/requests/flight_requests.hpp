// Carries out the requests of mission and operator beside the intents.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/requests/keep_out_zones.hpp"
#include "autonomy/requests/run_files.hpp"
#include "common/command.hpp"
#include "common/event_log.hpp"
#include "common/mission_request.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// One thread; called at the ticks of the behaviours.
class FlightRequests {
 public:
  /// `camera` may be null: then photographs are refused.
  FlightRequests(double hull_radius_m, const common::RgbdCameraConfig* camera, common::EventLog& log)
      : keep_out_(hull_radius_m),
        camera_(camera != nullptr ? std::optional(camera->mount.pose()) : std::nullopt),
        log_(log) {}

  /// Handles and answers commands about keep-out zones; returns nullopt for any other.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, const common::World& world);
  void take(const common::MissionRequest& request, const common::World& world);
  /// An answer from another part, with its event.
  void answered(common::MissionAnswer answer, common::Time now);

  /// A requested photograph is taken from this frame if it was measured after the request. Only of frames that
  /// Estimator::addFrame accepts.
  void addFrame(const std::shared_ptr<const common::RgbdFrame>& frame, const common::VehicleState& state);

  const KeepOutZones& keepOut() const { return keep_out_; }
  /// Gives up photographs for which no usable frame came.
  std::vector<common::MissionAnswer> takeAnswers(common::Time now);
  std::vector<RunFile> takeFiles();

 private:
  struct Pending {
    std::uint64_t id = 0;
    std::string name;
    common::Time asked;
  };
  common::MissionAnswer answerTo(const common::MissionRequest& request, const common::World& world);
  std::string addZone(const common::Polygon& zone, KeepOutZones::Owner owner, const common::World& world);

  KeepOutZones keep_out_;
  std::optional<common::Pose3> camera_;  ///< T_body_camera by the data sheet; nullopt without a camera.
  std::optional<Pending> photograph_;
  std::vector<RunFile> files_;
  std::vector<common::MissionAnswer> answers_;
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
