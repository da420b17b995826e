#include "flight/recognition_sink.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "common/jpeg_encoder.hpp"
#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "flight/topological_map.hpp"
#include "interfaces/run_folder.hpp"
#include "rendering/canvas.hpp"

namespace swiftlet::flight {
namespace {

/// A frame this near in time to the last look at an object shows it: jobs of 0.15 s, and frames every 0.2 s.
constexpr double kShows_s = 0.35;
/// A corner outside of the picture is worth this much of one inside, so that a whole view is better than any other.
constexpr double kOutside = 0.01;
constexpr int kJpegQuality = 90;
constexpr double kOutline_px = 2.0;

/// Around the middle, in order. Openings stand in the plane of their y and z, patterns lie in that of x and y.
std::array<Eigen::Vector3d, 4> corners(const common::RecognizedObject& object, const common::Pose3& T_camera_object) {
  const bool opening = object.passage != common::Passage::kNone || object.what == "mirror";
  const Eigen::Vector2d half = 0.5 * object.size_m;
  std::array<Eigen::Vector3d, 4> points;
  constexpr std::array<std::array<double, 2>, 4> kSigns = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = kSigns[i][0] * half.x(), b = kSigns[i][1] * half.y();
    points[i] = T_camera_object * (opening ? Eigen::Vector3d(0.0, a, b) : Eigen::Vector3d(a, b, 0.0));
  }
  return points;
}

/// Square root of the area that it covers; less for each corner outside of the picture, 0 behind the camera.
double size_px(const common::PinholeCamera& camera, const std::array<Eigen::Vector3d, 4>& corners) {
  double twice_px2 = 0.0, share = 1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(corners[i].x() > 0.05)) return 0.0;
    const Eigen::Vector2d a = camera.pixel(corners[i]);
    if (!(corners[(i + 1) % 4].x() > 0.05)) return 0.0;
    const Eigen::Vector2d b = camera.pixel(corners[(i + 1) % 4]);
    twice_px2 += a.x() * b.y() - a.y() * b.x();
    if (a.minCoeff() < 0.0 || a.x() > camera.width_px - 1 || a.y() > camera.height_px - 1) share *= kOutside;
  }
  return share * std::sqrt(0.5 * std::abs(twice_px2));
}

common::Image withOutline(const common::RgbdFrame& frame, const std::array<Eigen::Vector3d, 4>& corners,
                          const std::string& label) {
  constexpr rendering::Color kOutlineColor = rendering::rgb(0xffd43b), kHalo = rendering::rgb(0x202020);
  rendering::Canvas canvas(frame.color);
  std::array<Eigen::Vector2d, 5> outline;
  for (std::size_t i = 0; i < 5; ++i)
    outline[i] = frame.camera.pixel(corners[i % 4]) + Eigen::Vector2d(0.5, 0.5);  // Canvas counts from corners.
  canvas.polyline(outline, 2.5 * kOutline_px, kHalo.withAlpha(140));
  canvas.polyline(outline, kOutline_px, kOutlineColor);
  const Eigen::Vector2d middle = 0.25 * (outline[0] + outline[1] + outline[2] + outline[3]);
  canvas.text(label, middle, 11.0, kOutlineColor, rendering::Align::kCenter, kHalo.withAlpha(200));
  return canvas.take();
}

}  // namespace

void RecognitionSink::world(const std::shared_ptr<const common::World>& world) {
  if (!world->objects || !world->map3d || !world->map3d->frame || !world->map3d->tracked) return;
  const common::Map3dLayer& camera = *world->map3d;
  for (const common::RecognizedObject& object : world->objects->objects) {
    // What is seen once is mostly seen never again, and a frame is kept for each.
    if (object.looks < 2 || std::abs((camera.frame->stamps.measured - object.last_seen).seconds()) > kShows_s) continue;
    const common::Pose3 T_camera_object = camera.T_map_camera.inverse() * object.T_map_object;
    Look& best = best_[object.id];
    const double seen_px = size_px(camera.frame->camera, corners(object, T_camera_object));
    if (seen_px > best.size_px) best = {camera.frame, T_camera_object, seen_px};
  }
}

void RecognitionSink::writeNow(const common::World& world) {
  if (world.objects)
    for (const common::RecognizedObject& object : world.objects->objects) {
      const auto look = best_.find(object.id);
      if (!object.confirmed || look == best_.end() || !look->second.frame) continue;
      const common::Image picture =
          withOutline(*look->second.frame, corners(object, look->second.T_camera_object), labelOf(object));
      folder_.saveObjectPicture(object,
                                common::JpegEncoder(common::ImageContent::kPhoto).encode(picture, kJpegQuality));
    }
  folder_.savePlaces(topologicalMapOf(world, given_.get()));
}

}  // namespace swiftlet::flight
