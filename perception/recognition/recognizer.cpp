#include "perception/recognition/recognizer.hpp"

#include <cstddef>

namespace swiftlet::perception {

bool hasWholePicture(const Observation& observation) {
  if (observation.picture == nullptr) return false;
  const vision::GrayImage& gray = observation.picture->gray;
  const common::PinholeCamera& camera = observation.picture->camera;
  return gray.width_px > 0 && gray.height_px > 0 && gray.width_px == camera.width_px &&
         gray.height_px == camera.height_px && camera.fx_px > 0.0 && camera.fy_px > 0.0 &&
         gray.values.size() == static_cast<std::size_t>(gray.width_px) * static_cast<std::size_t>(gray.height_px);
}

bool hasWholeDepths(const Observation& observation) {
  if (observation.frame == nullptr) return false;
  const common::DepthImage& depth = observation.frame->depth;
  const common::PinholeCamera& camera = observation.frame->camera;
  return depth.width_px > 0 && depth.height_px > 0 && depth.width_px == camera.width_px &&
         depth.height_px == camera.height_px && camera.fx_px > 0.0 && camera.fy_px > 0.0 &&
         depth.depth_m.size() == static_cast<std::size_t>(camera.pixels());
}

}  // namespace swiftlet::perception
