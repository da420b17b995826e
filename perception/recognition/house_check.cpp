#include "perception/recognition/house_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/quantile.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::perception {
namespace {

constexpr int kCheckStep_px = 4;
/// A depth is that of the shape within three standard deviations and this much: plaster, beams, the fit itself.
constexpr double kOnShape_m = 0.12;
/// What stands between these distances beside the shape would be a part of a larger house.
constexpr double kBesideFrom_m = 0.08, kBeside_m = 0.35, kBesideHeight_m = 0.4;
/// Faces are sampled on a grid of this size.
constexpr double kFaceGrid_m = 0.25;
/// Medians of fewer points are noise.
constexpr std::size_t kFacePoints = 25;

/// Of the limits: docs/recognition.md, section "House".
constexpr int kLeastOn = 120;
constexpr double kRoofThrough = 0.02, kWallThrough = 0.45, kBesideShare = 0.02, kHiddenShare = 0.5;
constexpr double kLeastInView = 0.75, kFaceOff_m = 0.10, kGroundOff_m = 0.12;

bool isAtChimney(const Eigen::Vector3d& at, const HouseModel& model) {
  constexpr double kAround_m = 0.2;
  // Either end may be the chimney's: which one is decided by the picture.
  const auto near = [&](double turned) {
    return std::abs(at.x() - turned * model.chimney_x_m) < 0.5 * model.chimney_side_m + kAround_m &&
           std::abs(at.y() - turned * model.chimney_y_m) < 0.5 * model.chimney_side_m + kAround_m;
  };
  return at.z() > model.eaves_m && at.z() < model.chimney_top_m + kAround_m && (near(1.0) || near(-1.0));
}

/// It stands on the ground beside the body, not in it.
bool isBeside(const Eigen::Vector3d& at, const HouseModel& model) {
  const double x_m = std::abs(at.x()) - 0.5 * model.length_m, y_m = std::abs(at.y()) - 0.5 * model.width_m;
  const bool above = at.z() > model.ridge_m + kOnShape_m || at.z() > model.roofAt_m(at.y()) + 2.0 * kOnShape_m;
  const bool outside = std::max(x_m, y_m) > kBesideFrom_m || above;
  return outside && std::max(x_m, y_m) < kBeside_m && at.z() > kBesideHeight_m &&
         at.z() < model.chimney_top_m + kBeside_m;
}

/// Points of the faces that are turned to the camera, evenly spread.
std::vector<Eigen::Vector3d> facesTowards(const HouseModel& model, const HouseBody& body,
                                          const Eigen::Vector3d& camera_m) {
  std::vector<Eigen::Vector3d> samples;
  const double half_x = 0.5 * model.length_m, half_y = 0.5 * model.width_m;
  for (int face = 0; face < kHouseFaces; ++face) {
    if (body.off_m(camera_m, face) <= 0.05) continue;
    const bool gable = face == kGableAhead || face == kGableBehind;
    const double half_m = gable ? half_y : half_x;
    for (double along = -half_m + 0.5 * kFaceGrid_m; along < half_m; along += kFaceGrid_m) {
      const double sign = face % 2 == 0 ? 1.0 : -1.0;
      if (isRoof(face)) {
        for (double y = 0.5 * kFaceGrid_m; y < half_y; y += kFaceGrid_m)
          samples.emplace_back(along, sign * y, model.roofAt_m(y));
      } else {
        const double top_m = gable ? model.roofAt_m(along) : model.eaves_m;
        for (double z = 0.5 * kFaceGrid_m; z < top_m; z += kFaceGrid_m)
          samples.emplace_back(gable ? sign * half_x : along, gable ? along : sign * half_y, z);
      }
    }
  }
  return samples;
}

/// The roof counts most: its ends say how large the house is.
double inViewShare(const HousePose& pose, const HouseModel& model, const HouseBody& body, const DepthView& view) {
  const Eigen::Matrix3d R_camera_level = view.R_level_camera.transpose();
  double all = 0.0, seen = 0.0;
  for (const Eigen::Vector3d& sample : facesTowards(model, body, pose.inHouse_m(Eigen::Vector3d::Zero()))) {
    const double weight = sample.z() >= model.eaves_m - 0.5 * kFaceGrid_m ? 1.0 : 0.25;
    all += weight;
    const Eigen::Vector3d at = R_camera_level * pose.inLevel_m(sample);
    if (at.x() < 0.2 || at.x() > view.range_max_m) continue;
    const Eigen::Vector2d pixel = view.camera.pixel(at);
    if (pixel.minCoeff() >= 0.0 && pixel.x() <= view.camera.width_px - 1 && pixel.y() <= view.camera.height_px - 1)
      seen += weight;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace

double HouseEvidence::share() const {
  const int all = on + roof_through + beside + before;
  return all > 0 ? static_cast<double>(on) / all : 0.0;
}

HouseEvidence evidenceFor(const HousePose& pose, const HouseModel& model, const DepthView& view, double ground_m) {
  const HouseBody body(model);
  const Eigen::Vector3d camera_m = pose.inHouse_m(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d R_house_level =
      Eigen::AngleAxisd(-pose.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  HouseEvidence evidence;
  evidence.ground_off_m = std::abs(pose.position_m.z() - ground_m);
  evidence.in_view = inViewShare(pose, model, body, view);
  std::array<std::vector<double>, kHouseFaces> off_m;
  for (int v = 0; v < view.camera.height_px; v += kCheckStep_px)
    for (int u = 0; u < view.camera.width_px; u += kCheckStep_px) {
      const float measured = view.depth.at(u, v);
      if (measured <= 0.0F) continue;
      const Eigen::Vector3d ray_level = view.ray(u, v), ray = R_house_level * ray_level;
      // What is too far is behind everything.
      const double depth_m = common::isMeasured(measured) ? static_cast<double>(measured) : 1e3;
      const double sigma_m = std::min(1.0, depth_m * depth_m * view.inverse_depth_sigma_1_m) * ray.norm();
      const Eigen::Vector3d at = camera_m + depth_m * ray;
      const auto entry = body.enteredBy(camera_m, ray);
      if (isAtChimney(at, model)) {
        ++evidence.on;
        continue;
      }
      if (!entry || entry->depth_m > view.range_max_m) {
        if (isBeside(at, model)) ++evidence.beside;
        continue;
      }
      const double off = body.off_m(at, entry->face);
      const double along = std::abs(body.faces()[static_cast<std::size_t>(entry->face)].normal.dot(ray.normalized()));
      if (std::abs(off) < kOnShape_m + 3.0 * along * sigma_m) {
        ++evidence.on;
        off_m[static_cast<std::size_t>(entry->face)].push_back(off);
      } else if (depth_m > entry->depth_m) {
        ++(isRoof(entry->face) ? evidence.roof_through : evidence.wall_through);
      } else if (isBeside(at, model)) {
        ++evidence.beside;
      } else {
        ++evidence.before;
      }
    }
  for (const std::vector<double>& face : off_m)
    if (face.size() >= kFacePoints)
      evidence.face_off_m = std::max(evidence.face_off_m, std::abs(common::quantile(face, 0.5)));
  return evidence;
}

bool isThatHouse(const HouseEvidence& evidence) {
  const int on = evidence.on;
  return on >= kLeastOn && evidence.in_view >= kLeastInView && evidence.roof_through <= kRoofThrough * on &&
         evidence.wall_through <= kWallThrough * on && evidence.beside <= kBesideShare * on &&
         evidence.before <= kHiddenShare * on && evidence.face_off_m <= kFaceOff_m &&
         evidence.ground_off_m <= kGroundOff_m;
}

}  // namespace swiftlet::perception
