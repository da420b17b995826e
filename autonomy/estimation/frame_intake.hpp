// Which frames of the RGB-D camera are used, and when they are there: those that cannot be used are left out, the
// others come directly or over a radio. The reasons, a silent camera and a slow radio leave events.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "autonomy/arrivals/silence_watch.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "mapping3d/link/radio_link.hpp"

namespace swiftlet::autonomy {

struct RgbdCounts {
  std::uint64_t frames = 0;  ///< Frames that arrived and could be used.
  /// Frames that are repeated (also as a picture with a new stamp), late, of the future, without images of the camera's
  /// size, or blank.
  std::uint64_t skipped = 0;
  std::uint64_t blank = 0;   ///< Skipped frames with a black or a white picture.
  std::uint64_t mapped = 0;  ///< Frames that were aligned to the map and drawn.
  std::uint64_t lost = 0;    ///< Frames that did not fit and were left out.
};

/// One thread.
class FrameIntake {
 public:
  FrameIntake(const mapping3d::RadioLinkConfig& radio, const common::RgbdCameraConfig& camera, common::EventLog& log);

  /// False for a frame that cannot be used: it is counted and left out.
  bool add(std::shared_ptr<const common::RgbdFrame> frame);
  /// Takes what has come over the radio, and detects a silent camera. To be called at every tick.
  void watch(common::Time now);
  /// The newest frame that is there and was not taken before; null without one.
  std::shared_ptr<const common::RgbdFrame> take() { return std::exchange(here_, nullptr); }

  /// Without those that are mapped, or lost.
  const RgbdCounts& counts() const { return counts_; }
  /// nullopt without a radio.
  std::optional<mapping3d::RadioCounts> radioCounts() const {
    return radio_ ? std::optional(radio_->counts()) : std::nullopt;
  }

 private:
  const char* faultOf(const common::RgbdFrame& frame);
  void skip(const char* fault, common::Time now);
  void watchRadio(common::Time now);

  common::EventLog& log_;
  bool has_noise_;  ///< By the data sheet; otherwise equal pictures are right ones while nothing moves.
  SilenceWatch silence_;
  double radio_oldest_s_;
  std::optional<mapping3d::RadioLink> radio_;
  std::shared_ptr<const common::RgbdFrame> last_;  ///< The last usable one; null before it.
  std::shared_ptr<const common::RgbdFrame> here_;  ///< Not taken yet; null without one.
  std::set<std::string> faults_;                   ///< Those that left an event.
  std::optional<common::Time> through_at_;         ///< When a frame last came through the radio.
  common::Hysteresis stuck_;                       ///< No frame comes through the radio.
  int most_halvings_ = 0;                          ///< Most halvings of frames that an event has reported.
  RgbdCounts counts_;
};

}  // namespace swiftlet::autonomy
