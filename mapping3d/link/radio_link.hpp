// The radio between the camera and the computer that maps: a given number of bytes a second, and no more.
//
//   frame --> waits while the radio is busy --> packed --> on the way, bytes / rate --> unpacked
//               ^--- a newer frame replaces it               \--> too old on arrival: dropped
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "common/config_fwd.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"

namespace swiftlet::mapping3d {

struct RadioLinkConfig {
  double link_kB_s = 0.0;
  int jpeg_quality = 80;
  double oldest_s = 0.3;

  void describe(common::config::Fields& fields);
  bool isUsed() const { return link_kB_s > 0.0; }
};

struct RadioCounts {
  std::uint64_t offered = 0;    ///< Frames that the camera gave.
  std::uint64_t sent = 0;       ///< Frames that arrived.
  std::uint64_t replaced = 0;   ///< Frames that a newer one replaced before they were sent.
  std::uint64_t late = 0;       ///< Frames that were too old when they had arrived.
  std::uint64_t raw_bytes = 0;  ///< Bytes of all frames that were offered.
  std::uint64_t bytes = 0;      ///< Bytes that went over the radio.
};

/// A function of the frames and the times at which it is asked. One thread.
class RadioLink {
 public:
  /// The link must be used.
  explicit RadioLink(const RadioLinkConfig& config) : config_(config) {}

  /// A frame whose images have the size of its camera, arrived at its stamp.
  void offer(std::shared_ptr<const common::RgbdFrame> frame);
  /// The next frame that has come through by `now`; null without one. Ask until there is none, with a `now` that never
  /// goes back. The stamp of the arrival is that on this side of the radio.
  std::shared_ptr<const common::RgbdFrame> take(common::Time now);

  const RadioCounts& counts() const { return counts_; }

 private:
  struct OnTheWay {
    std::shared_ptr<const common::RgbdFrame> frame;
    common::Time arrives;
  };
  /// Sends the waiting frame if the radio is free for it by `now`.
  void sendIfFree(common::Time now);

  RadioLinkConfig config_;
  std::shared_ptr<const common::RgbdFrame> waiting_;
  std::optional<OnTheWay> on_the_way_;
  common::Time free_from_;  ///< When the radio has sent the last frame.
  RadioCounts counts_;
};

}  // namespace swiftlet::mapping3d
