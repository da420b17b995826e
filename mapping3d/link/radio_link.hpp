// The radio between the camera and the computer that maps: a given number of bytes a second, and no more.
//
//   frame --> waits while the radio is busy --> packed --> on the way, bytes / rate --> unpacked
//               ^--- a newer frame replaces it    |          \--> too old on arrival: dropped
//                                                 \-- it would be too old on arrival: halved, and so are those after it
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "common/config_fwd.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "mapping3d/link/frame_packet.hpp"

namespace swiftlet::mapping3d {

struct RadioLinkConfig {
  double link_kB_s = 0.0;
  double oldest_s = 0.3;  ///< Frames that were measured longer ago when they come through are dropped.

  void describe(common::config::Fields& fields);
  bool isUsed() const { return link_kB_s > 0.0; }
};

struct RadioCounts {
  std::uint64_t offered = 0;    ///< Frames that the camera gave.
  std::uint64_t sent = 0;       ///< Frames that arrived.
  std::uint64_t replaced = 0;   ///< Frames that a newer one replaced before they were sent.
  std::uint64_t late = 0;       ///< Frames that were too old when they had arrived.
  std::uint64_t halved = 0;     ///< Frames that were sent with fewer pixels than the camera's.
  std::uint64_t broken = 0;     ///< Frames that could not be unpacked.
  std::uint64_t raw_bytes = 0;  ///< Bytes of all frames that were offered.
  std::uint64_t bytes = 0;      ///< Bytes that went over the radio.
};

/// A function of the frames and the times of the calls. One thread.
class RadioLink {
 public:
  /// The link must be used.
  explicit RadioLink(const RadioLinkConfig& config) : config_(config) {}

  /// A frame whose images have the size of its camera, arrived at its stamp.
  void offer(std::shared_ptr<const common::RgbdFrame> frame);
  /// The next frame that has arrived by `now`; null without one. Call it until it returns null, with a `now` that never
  /// decreases. The stamp of the arrival is that on this side of the radio.
  std::shared_ptr<const common::RgbdFrame> take(common::Time now);

  const RadioCounts& counts() const { return counts_; }
  /// How often the width of frames is halved at present, because whole ones would come too late.
  int halvings() const { return halvings_; }

 private:
  struct OnTheWay {
    std::shared_ptr<const common::RgbdFrame> frame;
    common::Time arrives;
  };
  /// Sends the waiting frame if the radio is free for it by `now`.
  void sendIfFree(common::Time now);
  FramePacket fitting(const common::RgbdFrame& frame, common::Time start);
  common::Duration timeFor(const FramePacket& packet) const;

  RadioLinkConfig config_;
  std::shared_ptr<const common::RgbdFrame> waiting_;
  std::optional<OnTheWay> on_the_way_;
  common::Time free_from_;  ///< When the radio has sent the last frame.
  int halvings_ = 0;
  RadioCounts counts_;
};

}  // namespace swiftlet::mapping3d
