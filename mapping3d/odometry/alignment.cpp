#include "mapping3d/odometry/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"
#include "mapping3d/odometry/exposure_equations.hpp"

namespace swiftlet::mapping3d {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Gauss-Newton steps at a level of the pyramid, at most.
constexpr int kIterations = 8;
/// Least standard deviation of a grey value; the actual one is measured in every picture.
constexpr double kGraySigma = 4.0;
/// Standard deviation of a point's distance from the surface, in those of the depth.
constexpr double kSurfaceSigmaFactor = 2.0;
/// Points whose depths differ by more are on different surfaces.
constexpr double kSurfaceGate_m = 0.15;
/// Tukey's biweight reaches zero at this many standard deviations (95 % efficiency for a Gaussian).
constexpr double kTukey = 4.685;
/// Steps below these are smaller than the noise, and end the iterations.
constexpr double kSmallStep_m = 5e-5;
constexpr double kSmallStep_rad = 5e-5;
/// The iterations begin with this many times the standard deviation that grey values and surfaces have in an exact fit,
/// and never assume more: where the views differ, texture does not repeat.
constexpr double kWidest = 5.0;
/// Levels of the pyramid, the finest ones, that are aligned from a pose that corners gave.
constexpr std::size_t kLevelsNear = 2;
/// Fewer textured points do not distinguish a right pose from a wrong one.
constexpr int kLeastTextured = 50;
/// A surface point counts as agreeing within this many standard deviations.
constexpr double kAgreeing = 3.0;

double tukeyWeight(double residual_sigmas) {
  const double ratio = residual_sigmas / kTukey;
  if (std::abs(ratio) >= 1.0) return 0.0;
  const double inside = 1.0 - ratio * ratio;
  return inside * inside;
}

/// The correlation of pairs of numbers.
class CorrelationSums {
 public:
  void add(double a, double b) {
    ++count_;
    a_ += a;
    b_ += b;
    aa_ += a * a;
    bb_ += b * b;
    ab_ += a * b;
  }
  int count() const { return count_; }
  double value() const {
    const double variance_a = aa_ - a_ * a_ / count_, variance_b = bb_ - b_ * b_ / count_;
    if (!(variance_a > 0.0 && variance_b > 0.0)) return 0.0;
    return (ab_ - a_ * b_ / count_) / std::sqrt(variance_a * variance_b);
  }

 private:
  int count_ = 0;
  double a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// Standard deviations that an iteration assumes.
struct Spread {
  double gray = kGraySigma;
  double surface = 1.0;  ///< In those of an exact fit, which near surfaces have to a millimetre.
};

/// Sums over the points of one iteration.
struct Sums {
  ExposureEquations equations;
  int points = 0, visible = 0, measured = 0, agreeing = 0;
  int surfaces = 0;
  double absolute_gray = 0.0, absolute_surface = 0.0;
  CorrelationSums grays;
  struct Gray {
    Eigen::Vector3d point_camera_m;
    double weight;
  };
  std::vector<Gray> compared;  ///< The points whose grey values are in the equations.
};

/// One level of a frame at one pose.
class LevelErrors {
 public:
  LevelErrors(const PyramidLevel& level, const vision::DepthNoiseConfig& noise, const AlignmentConfig& config)
      : level_(level), noise_(noise), config_(config) {}

  void add(std::span<const ReferencePoint> points, const common::Pose3& T_camera_key, const Exposure& exposure,
           const Spread& spread, Sums& sums) const {
    const Eigen::Matrix3d rotation = T_camera_key.rotation.toRotationMatrix();
    for (const ReferencePoint& reference : points) {
      ++sums.points;
      const Eigen::Vector3d point = rotation * reference.point_camera_m.cast<double>() + T_camera_key.position_m;
      if (point.x() < noise_.nearest_m) continue;
      const Eigen::Vector2d pixel = level_.camera.pixel(point);
      if (!(pixel.x() >= 1.0 && pixel.y() >= 1.0 && pixel.x() < level_.camera.width_px - 2 &&
            pixel.y() < level_.camera.height_px - 2))
        continue;
      if (isHidden(point, pixel)) continue;
      ++sums.visible;
      if (!addSurface(reference, rotation, point, pixel, spread.surface, sums)) continue;
      if (reference.is_textured) addGray(reference, point, pixel, exposure, spread.gray, sums);
    }
  }

 private:
  /// Whether the frame sees a nearer surface there, as a wall of the next room. Nothing is known of the point then.
  bool isHidden(const Eigen::Vector3d& point, const Eigen::Vector2d& pixel) const {
    const float depth_m = level_.depth.at(static_cast<int>(pixel.x() + 0.5), static_cast<int>(pixel.y() + 0.5));
    return noise_.isUsable(depth_m) && static_cast<double>(depth_m) < point.x() - kSurfaceGate_m;
  }

  /// False if the frame sees another surface behind it.
  bool addSurface(const ReferencePoint& reference, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& point,
                  const Eigen::Vector2d& pixel, double spread, Sums& sums) const {
    const auto u = static_cast<int>(pixel.x() + 0.5), v = static_cast<int>(pixel.y() + 0.5);
    const float depth_m = level_.depth.at(u, v);
    if (!noise_.isUsable(depth_m)) return true;
    ++sums.measured;
    const Eigen::Vector3d seen = level_.camera.point_camera_m(u, v, static_cast<double>(depth_m));
    if (std::abs(seen.x() - point.x()) > kSurfaceGate_m) return false;
    const double sigma_m = std::hypot(kSurfaceSigmaFactor * noise_.sigma_m(point.x()), config_.surface_floor_m);
    if (!reference.hasNormal()) {
      const bool agrees = std::abs(seen.x() - point.x()) < kAgreeing * sigma_m + kSlope * point.x();
      sums.agreeing += agrees ? 1 : 0;
      return agrees;
    }
    const Eigen::Vector3d normal = rotation * reference.normal_camera.cast<double>();
    const double residual_m = normal.dot(point - seen);
    const double assumed_m = spread * sigma_m;
    const double weight = tukeyWeight(residual_m / assumed_m);
    sums.agreeing += std::abs(residual_m) < kAgreeing * sigma_m ? 1 : 0;
    ++sums.surfaces;
    sums.absolute_surface += std::min(std::abs(residual_m) / sigma_m, 4.0 * spread);
    if (weight == 0.0) return false;
    Vector6d jacobian;
    jacobian << -normal, normal.cross(seen);
    sums.equations.addSurface(jacobian, residual_m, weight / (assumed_m * assumed_m));
    return true;
  }

  void addGray(const ReferencePoint& reference, const Eigen::Vector3d& point, const Eigen::Vector2d& pixel,
               const Exposure& exposure, double sigma, Sums& sums) const {
    const auto u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
    const double fu = pixel.x() - u, fv = pixel.y() - v;
    const std::uint8_t *upper = level_.gray.row(v) + u, *lower = level_.gray.row(v + 1) + u;
    const double top = upper[0] + fu * (upper[1] - upper[0]), bottom = lower[0] + fu * (lower[1] - lower[0]);
    const double gray = top + fv * (bottom - top);
    const double du = (1.0 - fv) * (upper[1] - upper[0]) + fv * (lower[1] - lower[0]), dv = bottom - top;
    const auto reference_gray = static_cast<double>(reference.gray);
    const double residual = gray - exposure.gain * reference_gray - exposure.offset;
    sums.absolute_gray += std::min(std::abs(residual), 4.0 * sigma);
    sums.grays.add(gray, reference_gray);
    const double weight = tukeyWeight(residual / sigma);
    if (weight == 0.0) return;
    const double inverse_depth = 1.0 / point.x();
    const double along_u = du * level_.camera.fx_px * inverse_depth, along_v = dv * level_.camera.fy_px * inverse_depth;
    // The gradient of the grey value with respect to the point in the camera frame.
    const Eigen::Vector3d gradient((along_u * point.y() + along_v * point.z()) * inverse_depth, -along_u, -along_v);
    ExposureEquations::Vector8d jacobian;
    jacobian << -gradient, gradient.cross(point), -reference_gray, -1.0;
    sums.equations.addGray(jacobian, residual, weight / (sigma * sigma));
    sums.compared.push_back({point, weight / (sigma * sigma)});
  }

  /// A point without a normal may be seen on a slope, a pixel beside its place.
  static constexpr double kSlope = 0.02;

  const PyramidLevel& level_;
  const vision::DepthNoiseConfig& noise_;
  const AlignmentConfig& config_;
};

/// `above_coarsest` counts levels from the coarsest one, of frame and key frames: a radio may send them in different
/// sizes, whose pyramids have coarsest levels of one size.
Sums sumsAt(const LevelErrors& errors, std::span<const ReferenceView> views, std::size_t above_coarsest,
            const common::Pose3& T_map_camera, const Exposure& exposure, const Spread& spread) {
  Sums sums;
  const common::Pose3 T_camera_map = T_map_camera.inverse();
  for (const ReferenceView& view : views)
    errors.add(*(view.levels->rbegin() + std::min(above_coarsest, view.levels->size() - 1)),
               T_camera_map * view.T_map_key, exposure, spread, sums);
  return sums;
}

common::Pose3 moved(const common::Pose3& T_map_camera, const ExposureEquations::Vector8d& step) {
  common::Pose3 increment;
  increment.position_m = step.head<3>();
  increment.rotation = common::expSO3(step.segment<3>(3));
  common::Pose3 pose = T_map_camera * increment;
  pose.rotation.normalize();
  return pose;
}

Vector6d errorOf(const common::Pose3& T_map_camera, const PosePrior& prior) {
  const common::Pose3 error = prior.T_map_camera.inverse() * T_map_camera;
  Vector6d vector;
  vector << error.position_m, common::logSO3(error.rotation);
  return vector;
}

Alignment summary(const common::Pose3& T_map_camera, const Sums& sums) {
  const auto part = [](double some, double all) { return all > 0.0 ? some / all : 0.0; };
  Alignment alignment;
  alignment.T_map_camera = T_map_camera;
  alignment.information = sums.equations.poseInformation();
  alignment.overlap = part(sums.visible, sums.points);
  alignment.agreement = part(sums.agreeing, sums.measured);
  if (sums.grays.count() >= kLeastTextured) alignment.correlation = sums.grays.value();
  alignment.points = sums.agreeing;
  alignment.measured = sums.measured;
  alignment.textured = sums.grays.count();
  return alignment;
}

/// See Alignment::gradient_noise.
Matrix6d gradientNoise(const std::vector<Sums::Gray>& compared, const common::PinholeCamera& camera) {
  Matrix6d sum = Matrix6d::Zero();
  for (const auto& [point, weight] : compared) {
    const double along_u = camera.fx_px / point.x(), along_v = camera.fy_px / point.x();
    const Eigen::Vector3d by_u(along_u * point.y() / point.x(), -along_u, 0.0);
    const Eigen::Vector3d by_v(along_v * point.z() / point.x(), 0.0, -along_v);
    for (const Eigen::Vector3d& gradient : {by_u, by_v}) {
      Vector6d jacobian;
      jacobian << -gradient, gradient.cross(point);
      sum.noalias() += weight * jacobian * jacobian.transpose();
    }
  }
  return sum;
}

/// The mean absolute value of a Gaussian is 0.8 of its standard deviation.
Spread spreadOf(const Sums& sums) {
  Spread spread;
  if (sums.grays.count() > 0)
    spread.gray = std::clamp(1.25 * sums.absolute_gray / sums.grays.count(), kGraySigma, kWidest * kGraySigma);
  if (sums.surfaces > 0) spread.surface = std::clamp(1.25 * sums.absolute_surface / sums.surfaces, 1.0, kWidest);
  return spread;
}

}  // namespace

void AlignmentConfig::describe(common::config::Fields& fields) {
  fields("surface_floor_m", surface_floor_m, {0.0, 1},
         "Least standard deviation of a point's distance from the surface: key frames do not fit each other better "
         "than this, however near the surface is.");
}

Alignment judgePose(const FramePyramid& frame, std::span<const ReferenceView> views, const common::Pose3& T_map_camera,
                    const Exposure& exposure, const vision::DepthNoiseConfig& noise, const AlignmentConfig& config) {
  const LevelErrors errors(frame.back(), noise, config);
  return summary(T_map_camera, sumsAt(errors, views, 0, T_map_camera, exposure, {kWidest * kGraySigma, 1.0}));
}

Alignment align(const FramePyramid& frame, std::span<const ReferenceView> views, const PosePrior& prior,
                const Exposure& exposure, const vision::DepthNoiseConfig& noise, const AlignmentConfig& config,
                const std::optional<common::Pose3>& near) {
  common::Pose3 pose = near.value_or(prior.T_map_camera);
  Exposure estimate = exposure;
  Spread spread{kWidest * kGraySigma, kWidest};
  Sums sums;
  ExposureEquations measured;
  for (std::size_t level = near ? std::min(kLevelsNear, frame.size()) : frame.size(); level-- > 0;) {
    const LevelErrors errors(frame[level], noise, config);
    const std::span<const ReferenceView> used = level > 1 ? views.first(1) : views;
    for (int i = 0; i < kIterations; ++i) {
      sums = sumsAt(errors, used, frame.size() - 1 - level, pose, estimate, spread);
      spread = spreadOf(sums);
      measured = sums.equations;
      sums.equations.addPose(prior.information, errorOf(pose, prior));
      const ExposureEquations::Vector8d step = sums.equations.solve();
      pose = moved(pose, step);
      estimate.gain += step[6];
      estimate.offset += step[7];
      if (step.head<3>().norm() < kSmallStep_m && step.segment<3>(3).norm() < kSmallStep_rad) break;
    }
  }
  Alignment alignment = summary(pose, sums);
  alignment.measured_information = measured.poseInformation();
  alignment.gradient_noise = gradientNoise(sums.compared, frame.front().camera);
  alignment.exposure = estimate;
  return alignment;
}

}  // namespace swiftlet::mapping3d
