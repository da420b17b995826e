#include "mapping3d/odometry/found_place.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

constexpr double kLongestReach_s = 5.0;
/// Where a camera carried by a hand or a vehicle can have come to.
constexpr double kReach_m = 0.5, kReach_m_s = 3.0;
constexpr double kReach_rad = 0.5, kReach_rad_s = 2.0;
constexpr double kSamePlace_m = 0.5, kSamePlace_rad = 0.2;
constexpr double kLeastShown = 0.4, kLeastAlike = 0.6, kLeastAgreeing = 0.75;

bool isWithin(double distance_m, double turn_rad, const Pose3& a, const Pose3& b) {
  return (a.position_m - b.position_m).norm() <= distance_m && a.rotation.angularDistance(b.rotation) <= turn_rad;
}

}  // namespace

bool isInReach(const Pose3& last, const Pose3& found, double gap_s) {
  return gap_s > kLongestReach_s ||
         isWithin(kReach_m + kReach_m_s * gap_s, kReach_rad + kReach_rad_s * gap_s, last, found);
}

bool isSamePlace(const Pose3& a, const Pose3& b) { return isWithin(kSamePlace_m, kSamePlace_rad, a, b); }

bool isRecognized(const Alignment& fit, int least_textured) {
  return fit.overlap >= kLeastShown && fit.agreement >= kLeastAgreeing && fit.textured >= least_textured &&
         fit.correlation >= kLeastAlike;
}

}  // namespace swiftlet::mapping3d
