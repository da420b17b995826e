#include "mapping3d/link/radio_link.hpp"

#include <algorithm>
#include <utility>

#include "common/config_fields.hpp"
#include "mapping3d/link/frame_packet.hpp"

namespace swiftlet::mapping3d {

using common::Duration;
using common::RgbdFrame;
using common::Time;

namespace {

/// Quality of the colours that go over the radio; depths lose nothing (docs/decisions/cameras_and_lasers.md#045).
constexpr int kJpegQuality = 80;
/// Narrower pictures leave too few points to align.
constexpr int kLeastWidth_px = 160;
/// Twice the width takes four times the bytes and some more; sent at this multiple of the present ones, a frame must
/// arrive in good time before frames are sent larger again.
constexpr std::int64_t kLarger = 6;

}  // namespace

void RadioLinkConfig::describe(common::config::Fields& fields) {
  fields(
      "link_kB_s", link_kB_s, {0, 1e6},
      "Kilobytes a second that the radio between camera and computer carries; 0: no radio, frames come as they are.");
}

void RadioLink::offer(std::shared_ptr<const RgbdFrame> frame) {
  ++counts_.offered;
  counts_.raw_bytes += rawBytes(*frame);
  if (waiting_) ++counts_.replaced;
  waiting_ = std::move(frame);
  sendIfFree(waiting_->stamps.arrived);
}

std::shared_ptr<const RgbdFrame> RadioLink::take(Time now) {
  for (;;) {
    sendIfFree(now);
    if (!on_the_way_ || on_the_way_->arrives > now) return nullptr;
    std::shared_ptr<const RgbdFrame> frame = std::move(on_the_way_->frame);
    on_the_way_.reset();
    if ((frame->stamps.arrived - frame->stamps.measured).seconds() <= config_.oldest_s) {
      ++counts_.sent;
      return frame;
    }
    ++counts_.late;
  }
}

/// What arrives is unpacked from what was sent, so that the losses of the colours are those of a real link.
void RadioLink::sendIfFree(Time now) {
  if (on_the_way_ || !waiting_) return;
  const Time start = std::max(free_from_, waiting_->stamps.arrived);
  if (start > now) return;
  const auto whole = std::exchange(waiting_, nullptr);
  const FramePacket packet = fitting(*whole, start);
  counts_.bytes += packet.bytes();
  counts_.halved += packet.camera.width_px < whole->camera.width_px ? 1 : 0;
  free_from_ = start + timeFor(packet);
  auto frame = unpacked(packet);
  if (!frame) {
    ++counts_.broken;
    return;
  }
  frame->stamps.arrived = free_from_;
  on_the_way_ = {std::make_shared<const RgbdFrame>(std::move(*frame)), free_from_};
}

Duration RadioLink::timeFor(const FramePacket& packet) const {
  return Duration::fromSeconds(static_cast<double>(packet.bytes()) / (1000.0 * config_.link_kB_s));
}

/// As large as possible to arrive in time; the smallest if none would.
FramePacket RadioLink::fitting(const RgbdFrame& frame, Time start) {
  const Time latest = frame.stamps.measured + Duration::fromSeconds(config_.oldest_s);
  RgbdFrame small = frame;
  for (int i = 0; i < halvings_; ++i) small = halved(small);
  FramePacket packet = packed(small, kJpegQuality);
  while (start + timeFor(packet) > latest && small.camera.width_px >= 2 * kLeastWidth_px) {
    ++halvings_;
    small = halved(small);
    packet = packed(small, kJpegQuality);
  }
  if (halvings_ > 0 && start + timeFor(packet) * kLarger < latest) --halvings_;
  return packet;
}

}  // namespace swiftlet::mapping3d
