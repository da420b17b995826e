#include "interfaces/rgbd/rgbd_recorder.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>

#include "common/config.hpp"
#include "common/png_encoder.hpp"
#include "common/whole_frame.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {
namespace {

common::DepthCodes codesOf(const common::DepthImage& depth) {
  static const auto units_per_m = static_cast<float>(tumCalibration().depth_units_per_m);
  constexpr float kMostCode = 65534.0F;  // Some programs take the greatest number for a mark.
  common::DepthCodes codes{depth.width_px, depth.height_px, {}};
  codes.codes.reserve(depth.depth_m.size());
  for (const float depth_m : depth.depth_m) {
    const float code = std::round(depth_m * units_per_m);
    codes.codes.push_back(common::isMeasured(depth_m) && code <= kMostCode ? static_cast<std::uint16_t>(code)
                                                                           : std::uint16_t{0});
  }
  return codes;
}

Written writeImage(const std::filesystem::path& file, const std::vector<std::uint8_t>& png) {
  return writeAtomically(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

/// Of the recorded images: no distortion, the depth registered to the colour image.
std::string calibrationOf(const common::PinholeCamera& camera) {
  RgbdCalibration calibration = tumCalibration();
  calibration.color.width_px = camera.width_px;
  calibration.color.height_px = camera.height_px;
  calibration.color.fx_px = camera.fx_px;
  calibration.color.fy_px = camera.fy_px;
  calibration.color.cx_px = camera.cx_px;
  calibration.color.cy_px = camera.cy_px;
  return common::config::YamlPrinter(common::config::YamlPrinter::Comments::kYes).print(calibration);
}

}  // namespace

tl::expected<RgbdRecorder, FileError> RgbdRecorder::create(const std::filesystem::path& folder) {
  for (const char* name : {"rgb", "depth"}) {
    std::error_code error;
    std::filesystem::create_directories(folder / name, error);
    if (error)
      return tl::make_unexpected(
          FileError{common::Message("file.not-written", "{}: {}", (folder / name).string(), error.message())});
  }
  auto colors = AppendFile::create(folder / "rgb.txt");
  if (!colors) return tl::make_unexpected(colors.error());
  auto depths = AppendFile::create(folder / "depth.txt");
  if (!depths) return tl::make_unexpected(depths.error());
  return RgbdRecorder(folder, std::move(*colors), std::move(*depths));
}

Written RgbdRecorder::add(const common::RgbdFrame& frame) {
  if (!isWhole(frame.color) || !isWhole(frame.depth)) {
    ++left_out_;
    return {};
  }
  if (frames_ == 0) {
    if (Written written = writeAtomically(folder_ / "calibration.yaml", calibrationOf(frame.camera)); !written)
      return written;
  }
  const std::string stamp = fmt::format("{:.6f}", frame.stamps.measured.seconds());
  const std::string color = "rgb/" + stamp + ".png", depth = "depth/" + stamp + ".png";
  return writeImage(folder_ / color, encodePng(frame.color, common::ImageContent::kPhoto))
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
