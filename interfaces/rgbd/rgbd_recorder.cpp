#include "interfaces/rgbd/rgbd_recorder.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>

#include "common/png_encoder.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {
namespace {

constexpr double kUnitsPerMetre = 5000.0;  // Of the format.

common::DepthCodes codesOf(const common::DepthImage& depth) {
  constexpr float kMostCode = 65534.0F;  // Some programs take the greatest number for a mark.
  common::DepthCodes codes{depth.width_px, depth.height_px, {}};
  codes.codes.reserve(depth.depth_m.size());
  for (const float depth_m : depth.depth_m) {
    const float code = std::round(depth_m * static_cast<float>(kUnitsPerMetre));
    codes.codes.push_back(common::isMeasured(depth_m) && code <= kMostCode ? static_cast<std::uint16_t>(code)
                                                                           : std::uint16_t{0});
  }
  return codes;
}

Written writeImage(const std::filesystem::path& file, const std::vector<std::uint8_t>& png) {
  return writeAtomically(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

std::string calibrationOf(const common::PinholeCamera& camera) {
  return fmt::format(
      "# Of the recorded images: no distortion, the depth registered to the colour image.\n"
      "color: {{width_px: {}, height_px: {}, fx_px: {:.4f}, fy_px: {:.4f}, cx_px: {:.4f}, cy_px: {:.4f}}}\n"
      "depth_units_per_m: {:.0f}\n"
      "is_registered: true\n",
      camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, kUnitsPerMetre);
}

}  // namespace

tl::expected<RgbdRecorder, FileError> RgbdRecorder::create(const std::filesystem::path& folder) {
  for (const char* name : {"rgb", "depth"}) {
    std::error_code error;
    std::filesystem::create_directories(folder / name, error);
    if (error) return tl::make_unexpected(FileError{(folder / name).string() + ": " + error.message()});
  }
  auto colors = AppendFile::create(folder / "rgb.txt");
  if (!colors) return tl::make_unexpected(colors.error());
  auto depths = AppendFile::create(folder / "depth.txt");
  if (!depths) return tl::make_unexpected(depths.error());
  return RgbdRecorder(folder, std::move(*colors), std::move(*depths));
}

Written RgbdRecorder::add(const common::RgbdFrame& frame) {
  if (frames_ == 0) {
    if (Written written = writeAtomically(folder_ / "calibration.yaml", calibrationOf(frame.camera)); !written)
      return written;
  }
  const std::string stamp = fmt::format("{:.6f}", frame.stamps.measured.seconds());
  const std::string color = "rgb/" + stamp + ".png", depth = "depth/" + stamp + ".png";
  return writeImage(folder_ / color, encodePng(frame.color, common::PngContent::kPhoto))
      .and_then([&] { return writeImage(folder_ / depth, encodePng(codesOf(frame.depth))); })
      .and_then([&] { return colors_.append(stamp + " " + color + "\n"); })
      .and_then([&] { return depths_.append(stamp + " " + depth + "\n"); })
      .map([&] { ++frames_; });
}

Written RgbdRecorder::addTruth(common::Time time, const common::Pose3& T_map_camera) {
  if (!truth_) {
    auto made = TumWriter::create(folder_ / "groundtruth.txt");
    if (!made) return tl::make_unexpected(made.error());
    truth_ = std::move(*made);
  }
  return truth_->write({time, T_map_camera * T_camera_optical()});
}

}  // namespace swiftlet::interfaces
