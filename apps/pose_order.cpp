#include "apps/pose_order.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::apps {
namespace {

using common::InputError;
using common::Message;
using interfaces::PoseOrder;
using interfaces::RecordedPoses;

/// Whether all stamps are frame numbers at this rate. Files have stamps to the microsecond, some to 0.1 ms.
bool areFrames(const RecordedPoses& found, double rate_Hz) {
  constexpr double kWithin = 0.01;
  return std::all_of(found.poses.begin(), found.poses.end(), [&](const common::StampedPose& at) {
    const double frame = rate_Hz * at.stamp.seconds();
    return std::abs(frame - std::round(frame)) < kWithin;
  });
}

void numberByStamps(const std::string& file, RecordedPoses& found, const std::string& numbered_file) {
  for (const double rate_Hz : {1.0, interfaces::kNumberedFrames_Hz}) {
    if (!areFrames(found, rate_Hz)) continue;
    for (common::StampedPose& at : found.poses)
      at.stamp = common::Time::fromSeconds(std::round(rate_Hz * at.stamp.seconds()));
    return;
  }
  throw InputError(
      {file}, "",
      Message("poses.not-numbered", "has stamps, where {} has frame numbers: no pairs are known", numbered_file),
      fmt::format("write frame numbers where the stamps stand, or frame numbers / {:g}",
                  interfaces::kNumberedFrames_Hz));
}

/// With those that have no pose, where their places are known.
std::size_t framesOf(const RecordedPoses& found) {
  return found.poses.size() + (found.order == PoseOrder::kLines ? found.without_pose : 0);
}

void numberInOrder(RecordedPoses& found) {
  if (found.order == PoseOrder::kLines) return;
  double n = 0.0;
  for (common::StampedPose& at : found.poses) at.stamp = common::Time::fromSeconds(n++);
}

}  // namespace

PoseOrder giveOneClock(const std::string& estimate_file, RecordedPoses& estimate, const std::string& reference_file,
                       RecordedPoses& reference) {
  if (estimate.order == PoseOrder::kLines || reference.order == PoseOrder::kLines) {
    if (framesOf(estimate) != framesOf(reference))
      throw InputError(
          {estimate_file}, "",
          Message("poses.counts-differ",
                  "has {} poses and {} has {}: without stamps or frame numbers they are paired in their order",
                  framesOf(estimate), reference_file, framesOf(reference)),
          "give one pose for each frame, or frame numbers before the matrices");
    numberInOrder(estimate);
    numberInOrder(reference);
    return PoseOrder::kLines;
  }
  if (estimate.order == reference.order) return estimate.order;
  if (estimate.order == PoseOrder::kStamps)
    numberByStamps(estimate_file, estimate, reference_file);
  else
    numberByStamps(reference_file, reference, estimate_file);
  return PoseOrder::kNumbers;
}

std::string toString(PoseOrder order) {
  if (order == PoseOrder::kStamps) return "stamps";
  return order == PoseOrder::kNumbers ? "frame numbers" : "order";
}

}  // namespace swiftlet::apps
