#include "interfaces/rgbd/rgbd_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "common/row_major.hpp"

namespace swiftlet::interfaces {
namespace {

using common::DepthImage;
using common::Image;
using common::PinholeCamera;

/// No camera of this kind measures more, and stored numbers that mean more are marks of invalid pixels.
constexpr double kFarthestDepth_m = 60.0;
/// 7-Scenes marks invalid depth so.
constexpr std::uint16_t kInvalidCode = 65535;

/// The pinhole camera of an image of that lens at another resolution. Pixel centres have integer coordinates.
PinholeCamera cameraOf(const LensCalibration& lens, int width_px, int height_px) {
  const double scale = static_cast<double>(width_px) / lens.width_px;
  return {width_px,
          height_px,
          scale * lens.fx_px,
          scale * lens.fy_px,
          scale * (lens.cx_px + 0.5) - 0.5,
          scale * (lens.cy_px + 0.5) - 0.5};
}

/// Where the lens shows what an ideal camera of the same parameters shows at (u, v).
Eigen::Vector2d distorted(const LensCalibration& lens, const PinholeCamera& camera, double u, double v) {
  const double x = (u - camera.cx_px) / camera.fx_px, y = (v - camera.cy_px) / camera.fy_px;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {camera.cx_px + camera.fx_px * (x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x)),
          camera.cy_px + camera.fy_px * (y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y)};
}

/// For each pixel of an ideal camera, the column and the row of what the lens shows there. Empty for an ideal lens.
struct LensMap {
  cv::Mat_<float> columns, rows;
};

LensMap lensMap(const LensCalibration& lens, const PinholeCamera& camera) {
  if (!lens.isDistorted()) return {};
  LensMap map;
  map.columns.create(camera.height_px, camera.width_px);
  map.rows.create(camera.height_px, camera.width_px);
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector2d at = distorted(lens, camera, u, v);
      map.columns(v, u) = static_cast<float>(at.x());
      map.rows(v, u) = static_cast<float>(at.y());
    }
  return map;
}

/// What was not seen is 0. By the calling thread alone, as everything is.
void remap(const LensMap& map, void* from, void* to, int type, int interpolation) {
  static const bool one_thread = (cv::setNumThreads(1), true);
  SWIFTLET_CHECK(one_thread);
  const cv::Size size = map.columns.size();
  cv::Mat straight(size, type, to);
  cv::remap(cv::Mat(size, type, from), straight, map.columns, map.rows, interpolation);
}

Image undistorted(const LensMap& map, Image image) {
  if (map.columns.empty()) return image;
  Image straight = image;
  remap(map, image.rgb.data(), straight.rgb.data(), CV_8UC3, cv::INTER_LINEAR);
  return straight;
}

/// Depth is not interpolated: between two surfaces there is none.
DepthImage undistorted(const LensMap& map, DepthImage depth) {
  static_assert(DepthImage::kUnknown == 0.0F);
  if (map.columns.empty()) return depth;
  DepthImage straight = depth;
  remap(map, depth.depth_m.data(), straight.depth_m.data(), CV_32F, cv::INTER_NEAREST);
  return straight;
}

DepthImage inMetres(const common::DepthCodes& codes, double units_per_m) {
  DepthImage depth{codes.width_px, codes.height_px, {}};
  depth.depth_m.reserve(codes.codes.size());
  for (const std::uint16_t code : codes.codes) {
    const double depth_m = code / units_per_m;
    const bool is_measured = code != 0 && code != kInvalidCode && depth_m < kFarthestDepth_m;
    depth.depth_m.push_back(is_measured ? static_cast<float>(depth_m) : DepthImage::kUnknown);
  }
  return depth;
}

common::Pose3 poseOf(const DepthCameraPose& pose) {
  return {common::expSO3({pose.rotation_x_rad, pose.rotation_y_rad, pose.rotation_z_rad}),
          {pose.x_m, pose.y_m, pose.z_m}};
}

/// Moves each measured point into the colour camera's view; of several at a pixel the nearest stays.
DepthImage registered(const DepthImage& depth, const PinholeCamera& depth_camera, const PinholeCamera& color_camera,
                      const common::Pose3& T_color_depth) {
  DepthImage seen{color_camera.width_px, color_camera.height_px,
                  std::vector<float>(static_cast<std::size_t>(color_camera.pixels()), DepthImage::kUnknown)};
  const Eigen::Matrix3d rotation = T_color_depth.rotation.toRotationMatrix();
  // A pixel of the depth image covers this many of the colour image in each direction.
  const int size_px = std::max(1, static_cast<int>(std::ceil(color_camera.fx_px / depth_camera.fx_px - 0.05)));
  std::size_t i = 0;
  for (int v = 0; v < depth.height_px; ++v)
    for (int u = 0; u < depth.width_px; ++u, ++i) {
      const float depth_m = depth.depth_m[i];
      if (!common::isMeasured(depth_m)) continue;
      const Eigen::Vector3d point =
          rotation * depth_camera.point_camera_m(u, v, static_cast<double>(depth_m)) + T_color_depth.position_m;
      if (point.x() <= 0.0) continue;
      const Eigen::Vector2d pixel = color_camera.pixel(point);
      const double corner = 0.5 * (size_px - 1);
      const double left = std::floor(pixel.x() - corner + 0.5), top = std::floor(pixel.y() - corner + 0.5);
      if (!(left >= 0.0 && top >= 0.0 && left + size_px <= seen.width_px && top + size_px <= seen.height_px)) continue;
      for (int dv = 0; dv < size_px; ++dv)
        for (int du = 0; du < size_px; ++du) {
          float& there =
              seen.depth_m[common::rowMajor(static_cast<int>(top) + dv, seen.width_px, static_cast<int>(left) + du)];
          if (there == DepthImage::kUnknown || point.x() < static_cast<double>(there))
            there = static_cast<float>(point.x());
        }
    }
  return seen;
}

/// Colours of at least twice the width of the depths are halved: a frame has as many depths as colours, and those
/// between the measured ones would say nothing.
Image asFineAs(const common::DepthCodes& depth, Image color) {
  while (color.width_px >= 2 * depth.width_px && color.width_px % 2 == 0 && color.height_px % 2 == 0) {
    Image half{color.width_px / 2, color.height_px / 2, {}};
    half.rgb.resize(color.rgb.size() / 4);
    cv::Mat to(half.height_px, half.width_px, CV_8UC3, half.rgb.data());
    cv::resize(cv::Mat(color.height_px, color.width_px, CV_8UC3, color.rgb.data()), to, to.size(), 0.0, 0.0,
               cv::INTER_AREA);
    color = std::move(half);
  }
  return color;
}

}  // namespace

void LensCalibration::describe(common::config::Fields& fields) {
  fields("width_px", width_px, {16, common::kMostImageSide_px}, "Width of the images that the other numbers are for.");
  fields("height_px", height_px, {16, common::kMostImageSide_px},
         "Height of the images that the other numbers are for.");
  fields("fx_px", fx_px, {1, 1e5}, "Focal length across.");
  fields("fy_px", fy_px, {1, 1e5}, "Focal length down.");
  fields("cx_px", cx_px, {-1e4, 1e4}, "Principal point across; the centre of the top left pixel is 0.");
  fields("cy_px", cy_px, {-1e4, 1e4}, "Principal point down; the centre of the top left pixel is 0.");
  fields("k1", k1, {-10, 10}, "Radial distortion, second order.");
  fields("k2", k2, {-10, 10}, "Radial distortion, fourth order.");
  fields("p1", p1, {-1, 1}, "Tangential distortion, down.");
  fields("p2", p2, {-1, 1}, "Tangential distortion, across.");
  fields("k3", k3, {-10, 10}, "Radial distortion, sixth order.");
}

void DepthCameraPose::describe(common::config::Fields& fields) {
  fields("x_m", x_m, {-1, 1}, "Position of the depth camera in the colour camera, to the right.");
  fields("y_m", y_m, {-1, 1}, "Position of the depth camera in the colour camera, downwards.");
  fields("z_m", z_m, {-1, 1}, "Position of the depth camera in the colour camera, along the view.");
  fields("rotation_x_rad", rotation_x_rad, {-1, 1},
         "Rotation vector of the depth camera in the colour camera, along x.");
  fields("rotation_y_rad", rotation_y_rad, {-1, 1},
         "Rotation vector of the depth camera in the colour camera, along y.");
  fields("rotation_z_rad", rotation_z_rad, {-1, 1},
         "Rotation vector of the depth camera in the colour camera, along z.");
}

void RgbdCalibration::describe(common::config::Fields& fields) {
  fields.section("color", color, "Lens of the colour camera.");
  fields("depth_units_per_m", depth_units_per_m, {1, 1e6}, "What a depth of 1 m is stored as.");
  fields("is_registered", is_registered, "Whether the depth is stored in the colour camera's view.");
  fields.section("depth", depth, "Lens of the depth camera, if the depth is not registered.");
  fields.section("depth_pose", depth_pose,
                 "The depth camera in the colour camera, if the depth is not registered; x right, y down, z along the "
                 "view.");
}

common::Pose3 RgbdCalibration::T_recorded_color() const {
  return is_registered ? common::Pose3() : poseOf(depth_pose).inverse();
}

RgbdCalibration tumCalibration() {
  // The benchmark's page "Intrinsic camera calibration" recommends its ROS default for all of its cameras.
  RgbdCalibration calibration;
  calibration.depth_units_per_m = 5000.0;
  return calibration;
}

RgbdCalibration sevenScenesCalibration() {
  // Focal lengths as the data set's page states them for depth and as published with DSAC++ (E. Brachmann) for colour.
  RgbdCalibration calibration;
  calibration.is_registered = false;
  calibration.color.cx_px = 320.0;
  calibration.color.cy_px = 240.0;
  calibration.depth = calibration.color;
  calibration.depth.fx_px = calibration.depth.fy_px = 585.0;
  calibration.depth_pose = {-0.0256, 0.0001, 0.0020, 0.0082, -0.0079, -0.0027};
  return calibration;
}

bool hasShapeOf(const LensCalibration& lens, int width_px, int height_px) {
  return width_px > 0 &&
         static_cast<std::int64_t>(width_px) * lens.height_px == static_cast<std::int64_t>(height_px) * lens.width_px;
}

common::RgbdFrame makeFrame(const RgbdCalibration& calibration, common::Image color, const common::DepthCodes& depth) {
  common::RgbdFrame frame;
  if (!calibration.is_registered) color = asFineAs(depth, std::move(color));
  frame.camera = cameraOf(calibration.color, color.width_px, color.height_px);
  const LensMap color_map = lensMap(calibration.color, frame.camera);
  frame.color = undistorted(color_map, std::move(color));
  DepthImage measured = inMetres(depth, calibration.depth_units_per_m);
  if (calibration.is_registered) {
    frame.depth = undistorted(color_map, std::move(measured));
    return frame;
  }
  const PinholeCamera depth_camera = cameraOf(calibration.depth, depth.width_px, depth.height_px);
  const common::Pose3 T_color_depth =
      T_camera_optical() * poseOf(calibration.depth_pose) * T_camera_optical().inverse();
  frame.depth = registered(undistorted(lensMap(calibration.depth, depth_camera), std::move(measured)), depth_camera,
                           frame.camera, T_color_depth);
  return frame;
}

common::Pose3 T_camera_optical() {
  Eigen::Matrix3d axes;
  axes << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return {Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()};
}

}  // namespace swiftlet::interfaces
