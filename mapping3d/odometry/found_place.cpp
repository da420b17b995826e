#include "mapping3d/odometry/found_place.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

constexpr double kLongestReach_s = 5.0;
/// Where a camera carried by a hand or a vehicle can have come to.
constexpr double kReach_m = 0.5, kReach_m_s = 3.0;
constexpr double kReach_rad = 0.5, kReach_rad_s = 2.0;
constexpr double kSamePlace_m = 0.5, kSamePlace_rad = 0.2;
constexpr double kLeastShown = 0.4, kLeastAlike = 0.6;
constexpr int kLeastTexturedPoints = 150;
/// A frame of which less agrees fits weakly.
constexpr double kSurelyAgrees = 0.75;
/// Corners tell the pose to some 7 cm and 3 deg at steps of 20 cm and 20 deg.
constexpr double kConfirmed_m = 0.12, kConfirmed_rad = 0.06;
/// Right poses agree and correlate by more, wrong ones by less (docs/decisions/mapping3d.md#103).
constexpr double kSureAgreement = 0.9, kSureCorrelation = 0.85;
constexpr double kLeap_m = 0.1, kLeap_rad = 0.1, kLeapSigmas = 3.0;

bool isWithin(double distance_m, double turn_rad, const Pose3& a, const Pose3& b) {
  return (a.position_m - b.position_m).norm() <= distance_m && a.rotation.angularDistance(b.rotation) <= turn_rad;
}

}  // namespace

bool isInReach(const Pose3& last, const Pose3& found, double gap_s) {
  return gap_s > kLongestReach_s ||
         isWithin(kReach_m + kReach_m_s * gap_s, kReach_rad + kReach_rad_s * gap_s, last, found);
}

bool isSamePlace(const Pose3& a, const Pose3& b) { return isWithin(kSamePlace_m, kSamePlace_rad, a, b); }

bool isRecognized(const Alignment& fit) {
  return fit.overlap >= kLeastShown && fit.agreement >= kSurelyAgrees && fit.textured >= kLeastTexturedPoints &&
         fit.correlation >= kLeastAlike;
}

bool isConfirmed(const Alignment& fit, const Pose3& by_corners) {
  return isWithin(kConfirmed_m, kConfirmed_rad, by_corners, fit.T_map_camera);
}

bool isSure(const Alignment& fit) {
  return isRecognized(fit) && fit.agreement >= kSureAgreement && fit.correlation >= kSureCorrelation;
}

bool isLeap(const Alignment& fit, const PosePrior& prior) {
  if (prior.information.isZero() || fit.agreement >= kSurelyAgrees) return false;
  const double sigma_m = 1.0 / std::sqrt(prior.information(0, 0)), sigma_rad = 1.0 / std::sqrt(prior.information(3, 3));
  return !isWithin(std::max(kLeap_m, kLeapSigmas * sigma_m), std::max(kLeap_rad, kLeapSigmas * sigma_rad),
                   prior.T_map_camera, fit.T_map_camera);
}

}  // namespace swiftlet::mapping3d
