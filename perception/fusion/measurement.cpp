#include "perception/fusion/measurement.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "common/small_matrices.hpp"

namespace swiftlet::perception {
namespace {

using common::Time;

Measurement measurementOf(MeasurementKind kind, Time time) {
  Measurement m;
  m.stamp = time;
  m.kind = kind;
  return m;
}

bool isCovariance(const Eigen::Matrix3d& m) {
  if (!m.allFinite() || !m.isApprox(m.transpose(), 1e-6)) return false;
  return common::symmetricEigenvalues(m).minCoeff() > 0.0;
}
bool isCovariance(const Eigen::Matrix<double, 6, 6>& m) {
  return m.allFinite() && m.isApprox(m.transpose(), 1e-6) && m.llt().info() == Eigen::Success;
}

}  // namespace

Measurement poseClone(Time time, OdometrySource source) {
  Measurement m = measurementOf(MeasurementKind::kClone, time);
  m.source = source;
  return m;
}

Measurement measuredRelativePose(Time from, Time to, const common::Pose2& T_from_to, const Eigen::Matrix3d& covariance,
                                 const std::optional<common::UnobservableMotion>& unobservable_motion) {
  Measurement m = measurementOf(MeasurementKind::kRelativePose, to);
  m.from = from;
  m.pose = T_from_to;
  m.covariance = covariance;
  m.unobservable_motion = unobservable_motion;
  return m;
}

Measurement measuredRelativePose3(Time from, Time to, const common::Pose3& T_from_to,
                                  const Eigen::Matrix<double, 6, 6>& covariance) {
  Measurement m = measurementOf(MeasurementKind::kRelativePose3, to);
  m.from = from;
  m.pose3 = T_from_to;
  m.covariance6 = covariance;
  return m;
}

Measurement measuredHeight(Time time, double height_m, double variance_m2) {
  Measurement m = measurementOf(MeasurementKind::kHeight, time);
  m.value = height_m;
  m.covariance(0, 0) = variance_m2;
  return m;
}

Measurement knownVertical(Time time, const VerticalState& state) {
  Measurement m = measurementOf(MeasurementKind::kVertical, time);
  m.vertical = state.mean();
  m.covariance = state.covariance;
  return m;
}

Measurement measuredAbsolutePose(Time time, const common::Pose2& T_odom_body, const Eigen::Matrix3d& covariance) {
  Measurement m = measurementOf(MeasurementKind::kAbsolutePose, time);
  m.pose = T_odom_body;
  m.covariance = covariance;
  return m;
}

bool isValid(const Measurement& m) {
  switch (m.kind) {
    case MeasurementKind::kHeight:
      return std::isfinite(m.value) && std::isfinite(m.covariance(0, 0)) && m.covariance(0, 0) > 0.0;
    case MeasurementKind::kVertical:
      return m.vertical.allFinite() && isCovariance(m.covariance);
    case MeasurementKind::kRelativePose:
      return isFinite(m.pose) && m.stamp > m.from && isCovariance(m.covariance) &&
             (!m.unobservable_motion || isValid(*m.unobservable_motion));
    case MeasurementKind::kRelativePose3:
      return isFinite(m.pose3) && m.stamp > m.from && isCovariance(m.covariance6);
    case MeasurementKind::kAbsolutePose:
      return isFinite(m.pose) && isCovariance(m.covariance);
    case MeasurementKind::kClone:
      return true;
  }
  return false;
}

}  // namespace swiftlet::perception
