// links: interfaces common
// Any bytes as the calibration that other programs write beside their images: refused as InputError, or a camera that
// makes a frame. The first byte chooses between Open3D's JSON and a matrix.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "common/error.hpp"
#include "interfaces/rgbd/camera_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] % 2 == 0) {
      const auto rows = interfaces::parseCameraMatrix(bytes, "fuzzed");
      if (rows.size() != 9 && rows.size() != 16) std::abort();
      for (const double number : rows)
        if (!std::isfinite(number)) std::abort();
      return 0;
    }
    const interfaces::CameraFile camera = interfaces::parseOpen3dCamera(bytes, "fuzzed");
    const interfaces::LensCalibration& lens = camera.calibration.color;
    if (!(lens.fx_px > 0.0 && lens.width_px > 0 && camera.calibration.depth_units_per_m > 0.0)) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
