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

constexpr int kCheckStep_px = 2;
/// A depth is that of the shape within three standard deviations and this much: plaster, beams, the fit itself.
constexpr double kOnShape_m = 0.12;
/// What stands between these distances beside the shape would be a part of a larger house.
constexpr double kBesideFrom_m = 0.08, kBeside_m = 0.35, kBesideHeight_m = 0.4;
/// Faces are sampled on a grid of this size.
constexpr double kFaceGrid_m = 0.25;
/// Medians of fewer points are noise.
constexpr std::size_t kFacePoints = 100;

/// Of the limits: docs/recognition.md, section "House".
constexpr int kLeastOn = 500;
constexpr double kRoofThrough = 0.02, kWallThrough = 0.45, kBesideShare = 0.02, kHiddenShare = 0.5;
/// Of the strips at an end of the roof.
constexpr double kEndStrip_m = 0.3, kThroughShare = 0.3, kBeyondShare = 0.12;
constexpr int kEndLeast = 12, kEdgeLeast = 4;
constexpr double kLeastInView = 0.75, kFaceOff_m = 0.10, kSlopeOff_m = 0.045, kGroundOff_m = 0.12;

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

/// The same roof, going on at each end.
HouseModel grown(HouseModel model) {
  constexpr double kBy_m = kBesideFrom_m + kEndStrip_m;
  model.eaves_m = model.roofAt_m(0.5 * model.width_m + kBy_m);
  model.length_m += 2.0 * kBy_m;
  model.width_m += 2.0 * kBy_m;
  return model;
}

/// Adds one to the count of every end in whose strip the place is: inside the roof, or beyond it.
void countAtEnds(const Eigen::Vector3d& at, const HouseModel& model, int HouseEnd::*count, bool beyond,
                 std::array<HouseEnd, 4>& ends) {
  const double x_m = std::abs(at.x()) - 0.5 * model.length_m, y_m = std::abs(at.y()) - 0.5 * model.width_m;
  const auto inStrip = [&](double off_m) {
    return beyond ? off_m > kBesideFrom_m && off_m < kBesideFrom_m + kEndStrip_m : off_m < 0.0 && off_m > -kEndStrip_m;
  };
  // Beyond a corner is beyond no end.
  if (inStrip(x_m) && y_m < 0.0) ++(ends[at.x() > 0.0 ? 0 : 1].*count);
  if (inStrip(y_m) && x_m < 0.0) ++(ends[at.y() > 0.0 ? 2 : 3].*count);
}

}  // namespace

bool HouseEnd::isSeen() const {
  // A roof that returns nothing ends where the camera sees past it.
  const bool shown = (on >= kEndLeast && on >= unmeasured) || (on + unmeasured >= kEndLeast && free >= kEndLeast);
  return shown && !isElsewhere();
}
bool HouseEnd::isElsewhere() const {
  // Some pixels at an edge are of either side.
  return through > std::max<double>(kEndLeast, kThroughShare * on) ||
         beyond > std::max<double>(kEdgeLeast, kBeyondShare * on);
}

double HouseEvidence::share() const {
  const int all = on + roof_through + beside + before;
  return all > 0 ? static_cast<double>(on) / all : 0.0;
}

HouseEvidence evidenceFor(const HousePose& pose, const HouseModel& model, const DepthView& view, double ground_m) {
  const HouseBody body(model), larger(grown(model));
  const Eigen::Vector3d camera_m = pose.inHouse_m(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d R_house_level = Eigen::AngleAxisd(-pose.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  HouseEvidence evidence;
  evidence.ground_off_m = std::abs(pose.position_m.z() - ground_m);
  evidence.in_view = inViewShare(pose, model, body, view);
  std::array<std::vector<double>, kHouseFaces> off_m;
  std::array<std::array<std::vector<double>, 2>, 2> roof_off_m;  // Of the lower and the upper third of both roofs.
  for (int v = 0; v < view.camera.height_px; v += kCheckStep_px)
    for (int u = 0; u < view.camera.width_px; u += kCheckStep_px) {
      const float measured = view.depth.at(u, v);
      const Eigen::Vector3d ray = R_house_level * view.ray(u, v);
      const auto entry = body.enteredBy(camera_m, ray);
      const bool reached = entry && entry->depth_m <= view.range_max_m;
      if (measured <= 0.0F) {
        if (reached && isRoof(entry->face))
          countAtEnds(camera_m + entry->depth_m * ray, model, &HouseEnd::unmeasured, false, evidence.ends);
        continue;
      }
      // What is too far is behind everything.
      const double depth_m = common::isMeasured(measured) ? static_cast<double>(measured) : 1e3;
      const double sigma_m = std::min(1.0, depth_m * depth_m * view.inverse_depth_sigma_1_m) * ray.norm();
      const Eigen::Vector3d at = camera_m + depth_m * ray;
      if (isAtChimney(at, model)) {
        ++evidence.on;
        continue;
      }
      if (!reached) {
        if (isBeside(at, model)) ++evidence.beside;
        const auto wider = larger.enteredBy(camera_m, ray);
        if (!wider || !isRoof(wider->face) || wider->depth_m > view.range_max_m) continue;
        const bool farther = depth_m > wider->depth_m + kOnShape_m + 3.0 * sigma_m;
        countAtEnds(camera_m + wider->depth_m * ray, model, farther ? &HouseEnd::free : &HouseEnd::beyond, true,
                    evidence.ends);
        continue;
      }
      const Eigen::Vector3d on_shape = camera_m + entry->depth_m * ray;
      const double off = body.off_m(at, entry->face);
      const double along = std::abs(body.faces()[static_cast<std::size_t>(entry->face)].normal.dot(ray.normalized()));
      if (std::abs(off) < kOnShape_m + 3.0 * along * sigma_m) {
        ++evidence.on;
        off_m[static_cast<std::size_t>(entry->face)].push_back(off);
        if (!isRoof(entry->face)) continue;
        countAtEnds(on_shape, model, &HouseEnd::on, false, evidence.ends);
        const double up = 1.0 - std::abs(on_shape.y()) / (0.5 * model.width_m);
        auto& roof = roof_off_m[static_cast<std::size_t>(entry->face - kRoofLeft)];
        if (up < 1.0 / 3.0) roof[0].push_back(off);
        if (up > 2.0 / 3.0) roof[1].push_back(off);
      } else if (depth_m > entry->depth_m) {
        ++(isRoof(entry->face) ? evidence.roof_through : evidence.wall_through);
        if (isRoof(entry->face)) countAtEnds(on_shape, model, &HouseEnd::through, false, evidence.ends);
      } else if (isBeside(at, model)) {
        ++evidence.beside;
      } else {
        ++evidence.before;
      }
    }
  for (const std::vector<double>& face : off_m)
    if (face.size() >= kFacePoints)
      evidence.face_off_m = std::max(evidence.face_off_m, std::abs(common::quantile(face, 0.5)));
  for (const auto& roof : roof_off_m)
    if (std::min(roof[0].size(), roof[1].size()) >= kFacePoints)
      evidence.slope_off_m =
          std::max(evidence.slope_off_m, std::abs(common::quantile(roof[1], 0.5) - common::quantile(roof[0], 0.5)));
  return evidence;
}

/// Both gables, and one of the eaves: the other may be behind the ridge, whose place the slope tells.
bool endsWhereItShould(const std::array<HouseEnd, 4>& ends) {
  const bool elsewhere = std::any_of(ends.begin(), ends.end(), [](const HouseEnd& end) { return end.isElsewhere(); });
  return !elsewhere && ends[0].isSeen() && ends[1].isSeen() && (ends[2].isSeen() || ends[3].isSeen());
}

bool isThatHouse(const HouseEvidence& evidence) {
  const int on = evidence.on;
  return endsWhereItShould(evidence.ends) && on >= kLeastOn && evidence.in_view >= kLeastInView &&
         evidence.roof_through <= kRoofThrough * on && evidence.wall_through <= kWallThrough * on &&
         evidence.beside <= kBesideShare * on && evidence.before <= kHiddenShare * on &&
         evidence.face_off_m <= kFaceOff_m && evidence.slope_off_m <= kSlopeOff_m &&
         evidence.ground_off_m <= kGroundOff_m;
}

}  // namespace swiftlet::perception
