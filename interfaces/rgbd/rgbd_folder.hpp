// The frames of a recording, one after another. Frames that cannot be used are skipped and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::interfaces {

/// Why a frame was skipped.
enum class FrameFault {
  kMissing,     ///< One of its files is not there, or cannot be opened.
  kUnreadable,  ///< An image is cut off, damaged or of another kind.
  kOtherSize,   ///< Its images have not the shape of the calibration.
  kNoDepth,     ///< Hardly a pixel was measured.
  kOtherScale,  ///< Depths that no camera measures: the scale is another one.
  kBlack,
  kWhite,
  kRepeated,       ///< Pictures that equal those of the frame before.
  kStampRepeated,  ///< Not later than the frame before.
};
inline constexpr std::size_t kFrameFaults = 9;

/// For people: "an image is damaged or cut off".
const char* toString(FrameFault fault);

struct SkippedFrame {
  FrameFault fault;
  std::string detail;  ///< The file and the reason.
};

class RgbdBagImages;

class RgbdFolder {
 public:
  /// Frames are made with the calibration of the listing.
  explicit RgbdFolder(RgbdListing listing);
  ~RgbdFolder();
  RgbdFolder(RgbdFolder&&) noexcept;

  /// The next usable frame, in the order of the stamps; nullopt at the end.
  std::optional<common::RgbdFrame> next();

  /// By how much the depth of the newest frame was taken later than its colour, whose time is the frame's.
  common::Duration depthLater() const { return at_ > 0 ? listing_.pairs[at_ - 1].depth_later : common::Duration(); }
  const RgbdListing& listing() const { return listing_; }
  const RgbdCalibration& calibration() const { return listing_.calibration; }
  /// Pairs passed so far, skipped ones included.
  std::size_t passed() const { return at_; }
  std::uint64_t skipped(FrameFault fault) const { return skipped_[static_cast<std::size_t>(fault)]; }
  std::uint64_t skipped() const;
  /// The first frame that was skipped for this reason.
  const std::string& firstDetail(FrameFault fault) const { return first_[static_cast<std::size_t>(fault)]; }

 private:
  /// A frame, or the reason why it cannot be used.
  std::optional<common::RgbdFrame> read(const RgbdListing::Pair& pair, SkippedFrame& skipped);

  RgbdListing listing_;
  std::unique_ptr<RgbdBagImages> bag_;  ///< Only of a bag.
  std::size_t at_ = 0;
  std::optional<common::Time> last_stamp_;
  std::uint64_t last_hash_ = 0;
  std::array<std::uint64_t, kFrameFaults> skipped_{};
  std::array<std::string, kFrameFaults> first_;
};

}  // namespace swiftlet::interfaces
