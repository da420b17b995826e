#include "autonomy/estimation/camera_support.hpp"

#include "common/small_matrices.hpp"

namespace swiftlet::autonomy {
namespace {

/// A view that hardly constrains a direction for a second takes the deviation to 0.09 m/s, which is no reason to land;
/// before a bare wall it grows beyond this within some four seconds (docs/decisions/fail_safes.md#073).
constexpr double kSupported_m_s = 0.12;
constexpr double kSupported_m2_s2 = kSupported_m_s * kSupported_m_s;

}  // namespace

CameraSupport supportOf(const common::VehicleState& state) {
  const Eigen::Matrix3d& covariance = state.velocity_covariance_m2_s2;
  const Eigen::Vector2d horizontal = common::symmetricEigenvalues(Eigen::Matrix2d(covariance.topLeftCorner<2, 2>()));
  return {horizontal(1) < kSupported_m2_s2, covariance(2, 2) < kSupported_m2_s2};
}

}  // namespace swiftlet::autonomy
