// Frames of a camera on their way to work that takes its time: at most one waits until the pose of its time is known,
// and a newer one replaces it.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "autonomy/estimation/frame_situation.hpp"
#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// A frame, and where it was taken.
struct PlacedFrame {
  std::shared_ptr<const common::RgbdFrame> frame;
  int key = 0;
  common::Pose3 T_key_camera;
  double position_sigma_m = 0.0;
  double turn_rate_rad_s = 0.0;
  std::shared_ptr<const common::KeyPoses> keys;
};

/// One thread.
class FrameQueue {
 public:
  /// `period_s` is the least time from one frame that is taken to the next.
  explicit FrameQueue(double period_s) : period_s_(period_s) {}

  /// Of frames that can be used.
  void add(std::shared_ptr<const common::RgbdFrame> frame) {
    if (last_taken_ && frame->stamps.measured < *last_taken_ + common::Duration::fromSeconds(period_s_)) return;
    if (waiting_ && frame->stamps.measured <= waiting_->stamps.measured) return;
    waiting_ = std::move(frame);
  }

  /// The time at which the frame that is next was measured, by the flight's clock; nullopt without one.
  /// `clock_offset_s` is how late the camera's clock is.
  std::optional<common::Time> next(double clock_offset_s) const {
    if (!waiting_) return std::nullopt;
    return waiting_->stamps.measured + waiting_->row_time * (waiting_->camera.height_px / 2) -
           common::Duration::fromSeconds(clock_offset_s);
  }
  /// Until then it is worth waiting for a scan of its time. Only if there is a next one.
  common::Time waitUntil() const { return waiting_->stamps.arrived + common::Duration::fromSeconds(kWait_s); }

  /// The next frame; nullopt without a pose that a measurement supports. Only if there is a next one.
  std::optional<PlacedFrame> take(const FrameSituation& situation, const common::Pose3& T_body_camera,
                                  double position_sigma_m) {
    std::shared_ptr<const common::RgbdFrame> frame = std::exchange(waiting_, nullptr);
    last_taken_ = frame->stamps.measured;
    if (!situation.at_key || !situation.body || !situation.supported) return std::nullopt;
    return PlacedFrame{std::move(frame),
                       situation.at_key->key,
                       situation.at_key->T_key_body * T_body_camera,
                       position_sigma_m,
                       situation.body->motion.rate_body_rad_s.norm(),
                       situation.keys};
  }

 private:
  /// A frame waits this long for a scan that is not older, as the frames of the 3D map do by default.
  static constexpr double kWait_s = 0.05;

  double period_s_;
  std::shared_ptr<const common::RgbdFrame> waiting_;  ///< Null without one.
  std::optional<common::Time> last_taken_;            ///< When the last frame that was taken was measured.
};

}  // namespace swiftlet::autonomy
