#include "perception/recognition/house_chimney.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "common/pose2.hpp"
#include "common/rgbd_frame.hpp"
#include "common/square.hpp"

namespace swiftlet::perception {
namespace {

/// How far from the fitted place it is looked for: in coarse steps, and in fine ones around the best of these.
constexpr double kChimneyReach_m = 0.3, kChimneyStep_m = 0.1, kChimneyFine_m = 0.05;
/// Around the outline so much of the picture is compared, relative to the outline's size, and at least in pixels.
constexpr double kRingShare = 0.35, kRingLeast_px = 3.0;
constexpr int kLeastInside_px = 16;
/// An outline is placed to so much of a pixel.
constexpr double kOutlineSigma_px = 1.0;
/// Depths of the chimney: of a rough surface that is seen with the errors of the fit.
constexpr double kChimneyOff_m = 0.15;
/// Least evidence where the chimney is, and how much more that must be than at the other end.
constexpr double kLeastEvidence = 0.8, kMoreEvidence = 0.35;
/// A chimney farther from its fitted place is that of another house, or something else.
constexpr double kOutOfPlace_m = 0.2;
/// Variance of a grey value: in a picture without contrast nothing correlates.
constexpr double kGrayVariance = 4.0;

/// The pixels around a chimney that the pose has at a place of the roof.
class ChimneyWindow {
 public:
  ChimneyWindow(const HousePose& pose, const HouseModel& model, const DepthView& view)
      : pose_(pose),
        model_(model),
        view_(view),
        body_(model),
        R_house_level_(Eigen::AngleAxisd(-pose.yaw_rad, Eigen::Vector3d::UnitZ())),
        camera_house_m_(pose.inHouse_m(Eigen::Vector3d::Zero())) {}

  /// nullopt where the picture does not show its place whole.
  std::optional<ChimneyMatch> matchAt(const Eigen::Vector2d& moved_m, const vision::GrayImage& gray) const;

 private:
  struct Box {
    int left, right, top, bottom;
  };
  std::optional<Box> boxOf(const Eigen::Vector2d& middle_m) const;
  struct Depths {
    double chimney_m;
    double behind_m;  ///< Of the roof, if there were no chimney.
  };
  /// Where a pixel's ray meets the chimney; nullopt where it does not, or meets the roof before.
  std::optional<Depths> depthsAt(const Eigen::Vector3d& ray_house, const Eigen::Vector2d& middle_m) const;

  const HousePose& pose_;
  const HouseModel& model_;
  const DepthView& view_;
  HouseBody body_;
  Eigen::Matrix3d R_house_level_;
  Eigen::Vector3d camera_house_m_;
};

std::optional<ChimneyWindow::Box> ChimneyWindow::boxOf(const Eigen::Vector2d& middle_m) const {
  const Eigen::Matrix3d R_camera_level = view_.R_level_camera.transpose();
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {model_.roofAt_m(middle_m.y()), model_.chimney_top_m}) {
        const Eigen::Vector3d corner(middle_m.x() + x * model_.chimney_side_m, middle_m.y() + y * model_.chimney_side_m,
                                     z);
        const Eigen::Vector3d in_camera = R_camera_level * pose_.inLevel_m(corner);
        if (in_camera.x() < 0.2) return std::nullopt;
        const Eigen::Vector2d pixel = view_.camera.pixel(in_camera);
        low = low.cwiseMin(pixel);
        high = high.cwiseMax(pixel);
      }
  const double ring_px = std::max(kRingLeast_px, kRingShare * (high - low).minCoeff());
  const Box box{static_cast<int>(std::floor(low.x() - ring_px)), static_cast<int>(std::ceil(high.x() + ring_px)),
                static_cast<int>(std::floor(low.y() - ring_px)), static_cast<int>(std::ceil(high.y() + ring_px))};
  if (box.left < 0 || box.top < 0 || box.right >= view_.camera.width_px || box.bottom >= view_.camera.height_px)
    return std::nullopt;
  return box;
}

std::optional<ChimneyWindow::Depths> ChimneyWindow::depthsAt(const Eigen::Vector3d& ray_house,
                                                             const Eigen::Vector2d& middle_m) const {
  const double half_m = 0.5 * model_.chimney_side_m;
  const Eigen::Vector3d low(middle_m.x() - half_m, middle_m.y() - half_m, 0.0);
  const Eigen::Vector3d high(middle_m.x() + half_m, middle_m.y() + half_m, model_.chimney_top_m);
  double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(ray_house[i]) < 1e-9) {
      if (camera_house_m_[i] < low[i] || camera_house_m_[i] > high[i]) return std::nullopt;
      continue;
    }
    const double a = (low[i] - camera_house_m_[i]) / ray_house[i], b = (high[i] - camera_house_m_[i]) / ray_house[i];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  if (enters >= leaves) return std::nullopt;
  const auto roof = body_.enteredBy(camera_house_m_, ray_house);
  const double behind_m = roof ? roof->depth_m : std::numeric_limits<double>::infinity();
  if (behind_m < enters) return std::nullopt;
  return Depths{enters, behind_m};
}

std::optional<ChimneyMatch> ChimneyWindow::matchAt(const Eigen::Vector2d& moved_m,
                                                   const vision::GrayImage& gray) const {
  const Eigen::Vector2d middle_m = Eigen::Vector2d(model_.chimney_x_m, model_.chimney_y_m) + moved_m;
  const auto box = boxOf(middle_m);
  if (!box) return std::nullopt;
  double inside = 0.0, all = 0.0, sum_inside = 0.0, sum = 0.0, squares = 0.0;
  int measured = 0, there = 0;
  for (int v = box->top; v <= box->bottom; ++v)
    for (int u = box->left; u <= box->right; ++u) {
      const double value = gray.at(u, v);
      all += 1.0;
      sum += value;
      squares += value * value;
      const auto depths = depthsAt(R_house_level_ * view_.ray(u, v), middle_m);
      if (!depths) continue;
      inside += 1.0;
      sum_inside += value;
      const auto seen_m = static_cast<double>(view_.depth.at(u, v));
      const double within_m = kChimneyOff_m + 2.0 * common::square(depths->chimney_m) * view_.inverse_depth_sigma_1_m;
      // Where the roof is as near, a depth does not tell.
      if (!(seen_m > 0.0) || depths->behind_m < depths->chimney_m + 2.0 * within_m) continue;
      ++measured;
      if (std::abs(seen_m - depths->chimney_m) < within_m) ++there;
    }
  if (inside < kLeastInside_px || inside >= all) return std::nullopt;
  const double mean = sum / all, share = inside / all;
  const double variance = squares / all - mean * mean + kGrayVariance;
  ChimneyMatch match;
  match.correlation = std::abs(sum_inside / inside - mean) * share / std::sqrt(variance * share * (1.0 - share));
  match.in_depth = measured >= kLeastInside_px ? static_cast<double>(there) / measured : 0.0;
  match.moved_m = moved_m;
  const Eigen::Vector3d top(middle_m.x(), middle_m.y(), model_.chimney_top_m);
  match.sigma_m = std::hypot(kOutlineSigma_px * (top - camera_house_m_).norm() / view_.camera.fx_px,
                             kChimneyFine_m / std::sqrt(12.0));
  return match;
}

void tryAround(const ChimneyWindow& window, const vision::GrayImage& gray, const Eigen::Vector2d& middle_m, int steps,
               double step_m, std::optional<ChimneyMatch>& best) {
  for (int i = -steps; i <= steps; ++i)
    for (int j = -steps; j <= steps; ++j) {
      const auto match = window.matchAt(middle_m + step_m * Eigen::Vector2d(i, j), gray);
      if (match && (!best || match->evidence() > best->evidence())) best = match;
    }
}

/// The chimney is seen at a place of the house's floor: a measurement of where that stands.
HousePose fused(HousePose pose, const ChimneyMatch& chimney) {
  const Eigen::Rotation2Dd R(pose.yaw_rad);
  const Eigen::Matrix2d variance = common::square(chimney.sigma_m) * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d innovation = pose.covariance.topLeftCorner<2, 2>() + variance;
  const Eigen::Matrix<double, 4, 2> gain = pose.covariance.leftCols<2>() * innovation.inverse();
  const Eigen::Vector4d step = gain * (R * chimney.moved_m);
  pose.position_m += step.head<3>();
  pose.yaw_rad = common::wrapAngle(pose.yaw_rad + step[3]);
  pose.covariance -= (gain * innovation * gain.transpose()).eval();
  return pose;
}

}  // namespace

std::optional<ChimneyMatch> findChimney(const HousePose& pose, const HouseModel& model, const CameraPicture& picture,
                                        const DepthView& view) {
  const ChimneyWindow window(pose, model, view);
  std::optional<ChimneyMatch> best;
  tryAround(window, picture.gray, Eigen::Vector2d::Zero(),
            static_cast<int>(std::lround(kChimneyReach_m / kChimneyStep_m)), kChimneyStep_m, best);
  if (best) tryAround(window, picture.gray, best->moved_m, 1, kChimneyFine_m, best);
  return best;
}

std::optional<HouseWithChimney> fusedWithChimney(const HousePose& pose, const HouseModel& model,
                                                 const CameraPicture& picture, const DepthView& view) {
  HousePose turned = pose;
  turned.yaw_rad = common::wrapAngle(pose.yaw_rad + std::numbers::pi);
  const auto here = findChimney(pose, model, picture, view), there = findChimney(turned, model, picture, view);
  const double at_here = here ? here->evidence() : 0.0, at_there = there ? there->evidence() : 0.0;
  const double more = std::abs(at_here - at_there);
  if (std::max(at_here, at_there) < kLeastEvidence || more < kMoreEvidence) return std::nullopt;
  const bool is_here = at_here > at_there;
  const ChimneyMatch& chimney = is_here ? *here : *there;
  if (chimney.moved_m.norm() > kOutOfPlace_m) return std::nullopt;
  return HouseWithChimney{fused(is_here ? pose : turned, chimney), std::min(1.0, more)};
}

}  // namespace swiftlet::perception
