#include "autonomy/estimation/frame_intake.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "autonomy/arrivals/stamp_check.hpp"
#include "autonomy/estimation/frame_situation.hpp"
#include "common/blank_picture.hpp"
#include "common/whole_frame.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

/// A camera that sends no usable frame for this long is silent: five frames of the slowest that is flown, at 5 Hz.
constexpr double kSilent_s = 1.0;

const char* pictureFault(const common::Image& picture) {
  switch (common::blankOf(picture)) {
    case common::Blank::kBlack:
      return "its picture is black";
    case common::Blank::kWhite:
      return "its picture is white";
    case common::Blank::kNo:
      break;
  }
  return nullptr;
}

/// The noise of the depths makes each frame differ from the one before, unless nothing was measured. Bytes are
/// compared, because some drivers write NaN for a hole.
bool repeats(const common::DepthImage& depth, const common::DepthImage& last) {
  const std::vector<float>&a = depth.depth_m, &b = last.depth_m;
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0 &&
         std::any_of(a.begin(), a.end(), common::isMeasured);
}

}  // namespace

FrameIntake::FrameIntake(const mapping3d::RadioLinkConfig& radio, const common::RgbdCameraConfig& camera,
                         common::EventLog& log)
    : log_(log),
      has_noise_(camera.inverse_depth_noise_1_m > 0.0),
      silence_("camera", "frame", kSilent_s, log),
      radio_oldest_s_(radio.oldest_s) {
  if (radio.isUsed()) radio_.emplace(radio);
}

bool FrameIntake::add(std::shared_ptr<const common::RgbdFrame> frame) {
  const Time arrived = frame->stamps.arrived;
  if (const char* fault = faultOf(*frame)) {
    silence_.unusableArrived(arrived, fault);
    skip(fault, arrived);
    return false;
  }
  silence_.usableArrived(arrived);
  ++counts_.frames;
  last_ = frame;
  if (radio_)
    radio_->offer(std::move(frame));
  else
    here_ = std::move(frame);
  return true;
}

/// Null for a frame that can be used.
const char* FrameIntake::faultOf(const common::RgbdFrame& frame) {
  if (const char* fault = stampFault(frame.stamps, last_ ? std::optional(last_->stamps.measured) : std::nullopt))
    return fault;
  if (!isWhole(frame)) return "its images do not have the size of the camera";
  if (const char* fault = pictureFault(frame.color)) {
    ++counts_.blank;
    return fault;
  }
  if (has_noise_ && last_ && repeats(frame.depth, last_->depth)) return "it repeats the last picture with a new stamp";
  return nullptr;
}

void FrameIntake::skip(const char* fault, Time now) {
  ++counts_.skipped;
  if (faults_.insert(fault).second)
    log_.warn(now, kMapping3d, "a frame cannot be used", std::string(fault) + "; further ones are only counted");
}

void FrameIntake::watch(Time now) {
  if (radio_) watchRadio(now);
  silence_.watch(now);
}

void FrameIntake::watchRadio(Time now) {
  if (!through_at_) through_at_ = silence_.since();
  while (auto frame = radio_->take(now)) {
    here_ = std::move(frame);
    through_at_ = now;
    if (stuck_.update(false, now) == common::Edge::kLeft)
      log_.info(now, kMapping3d, "frames come through the radio again");
  }
  if (const int halvings = radio_->halvings(); halvings > most_halvings_) {
    most_halvings_ = halvings;
    log_.warn(
        now, kMapping3d, "frames are downscaled for the radio",
        fmt::format(
            "whole ones take longer over the radio than {:.2f} s; the map has 1 in {} of their pixels. A camera with "
            "fewer pixels or a faster radio loses none",
            radio_oldest_s_, std::int64_t{1} << 2 * halvings));
  }
  if (!through_at_ || (now - *through_at_).seconds() < kSilent_s || silence_.isDue(now)) return;
  if (stuck_.update(true, now) != common::Edge::kEntered) return;
  log_.warn(
      now, kMapping3d, "no frame comes through the radio",
      fmt::format("each takes longer than {:.2f} s, so there is no 3D map; use a faster radio or a camera with fewer "
                  "pixels, or set rgbd.radio.oldest_s",
                  radio_oldest_s_));
}

}  // namespace swiftlet::autonomy
