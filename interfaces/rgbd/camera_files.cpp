#include "interfaces/rgbd/camera_files.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include "common/config_check.hpp"
#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/line_fields.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/pose_matrices.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using nlohmann::json;

/// No file of a camera is longer.
constexpr std::size_t kMostCameraBytes = std::size_t{1} << 20;
/// The principal point of a camera is about in the middle: farther from it by this share of the width or height, the
/// numbers belong to images of another size. ScanNet's two sizes differ by a factor of two.
constexpr double kFromMiddle = 0.25;

bool isCameraFile(const fs::path& file) {
  std::error_code failure;
  return fs::exists(file, failure);
}

std::optional<fs::path> firstThere(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (isCameraFile(folder / name)) return folder / name;
  return std::nullopt;
}

InputError noCamera(const std::string& name, const std::string& why) {
  return InputError({name}, "", Message("camera.not-open3d", "is no camera of Open3D: {}", why),
                    "expected width, height and intrinsic_matrix, nine numbers, column after column");
}

double numberOf(const json& object, const char* key, const std::string& name) {
  const auto found = object.find(key);
  if (found == object.end()) throw noCamera(name, fmt::format("it has no `{}`", key));
  if (!found->is_number()) throw noCamera(name, fmt::format("its `{}` is not a number", key));
  return found->get<double>();
}

std::vector<double> matrixOf(const json& object, const std::string& name) {
  const auto found = object.find("intrinsic_matrix");
  if (found == object.end()) throw noCamera(name, "it has no `intrinsic_matrix`");
  std::vector<double> numbers;
  const auto take = [&](const json& item) {
    if (item.is_number()) numbers.push_back(item.get<double>());
  };
  if (found->is_array())
    for (const json& item : *found) take(item);
  if (numbers.size() != 9) throw noCamera(name, "its `intrinsic_matrix` has not nine numbers");
  return numbers;
}

/// Throws InputError where a number is outside what a camera can have.
void requireCamera(const RgbdCalibration& calibration, const std::string& name) {
  std::vector<common::Problem> problems = common::config::problemsOf(calibration);
  for (common::Problem& problem : problems) problem.location.file = name;
  if (!problems.empty()) throw InputError(std::move(problems));
}

int sizeOf(const json& object, const char* key, const std::string& name) {
  const double size = numberOf(object, key, name);
  if (!(size >= 1.0 && size <= common::kMostImageSide_px))
    throw noCamera(name, fmt::format("its `{}` is {}", key, size));
  return static_cast<int>(size);
}

/// A lens without distortion, from the rows of its matrix.
LensCalibration lensOf(const std::vector<double>& rows, int width_px, int height_px) {
  const std::size_t side = rows.size() == 9 ? 3 : 4;
  LensCalibration lens;
  lens.width_px = width_px;
  lens.height_px = height_px;
  lens.fx_px = rows[0];
  lens.cx_px = rows[2];
  lens.fy_px = rows[side + 1];
  lens.cy_px = rows[side + 2];
  return lens;
}

bool isInTheMiddle(const LensCalibration& lens) {
  return std::abs(lens.cx_px / lens.width_px - 0.5) < kFromMiddle &&
         std::abs(lens.cy_px / lens.height_px - 0.5) < kFromMiddle;
}

std::vector<double> readCameraMatrix(const fs::path& file) {
  return parseCameraMatrix(common::readText(file, kMostCameraBytes), file.string());
}

InputError ofAnotherSize(const fs::path& file, const LensCalibration& lens) {
  return InputError(
      {file.string()}, "",
      Message("camera.other-size", "its principal point ({:g}, {:g}) is far from the middle of images of {}x{}",
              lens.cx_px, lens.cy_px, lens.width_px, lens.height_px),
      "its numbers belong to images of another size: give those of these images (--intrinsics)");
}

CameraFile tsdfFusionCamera(const fs::path& file, const ImageSizes& sizes) {
  CameraFile camera{"tsdf-fusion", file, {}, false};
  camera.calibration.color = lensOf(readCameraMatrix(file), sizes.color_width_px, sizes.color_height_px);
  requireCamera(camera.calibration, file.string());
  if (!isInTheMiddle(camera.calibration.color)) throw ofAnotherSize(file, camera.calibration.color);
  return camera;
}

/// Where ScanNet's SensReader writes them, and where its smaller editions have them.
std::optional<fs::path> scanNetFile(const fs::path& folder, const std::string& name) {
  for (const fs::path& file : {folder / "intrinsic" / name, folder / name})
    if (isCameraFile(file)) return file;
  return std::nullopt;
}
std::optional<fs::path> scanNetIntrinsics(const fs::path& folder, const std::string& of) {
  const auto file = scanNetFile(folder, "intrinsic_" + of + ".txt");
  return file ? file : scanNetFile(folder, "intrinsics_" + of + ".txt");
}

common::Pose3 scanNetPose(const fs::path& folder, const std::string& of) {
  const auto file = scanNetFile(folder, "extrinsic_" + of + ".txt");
  if (!file) return {};
  const RecordedPoses found = readPoseMatrices(*file);
  requireFinitePoses(found, *file);
  return found.poses.front().pose;
}

DepthCameraPose depthPose(const common::Pose3& T_color_depth) {
  const Eigen::Vector3d rotation = common::logSO3(T_color_depth.rotation), &at = T_color_depth.position_m;
  return {at.x(), at.y(), at.z(), rotation.x(), rotation.y(), rotation.z()};
}

/// Colours that were scaled to the size of the depths have the numbers of the depths.
CameraFile scanNetCamera(const fs::path& folder, const fs::path& depth_file, const ImageSizes& sizes) {
  CameraFile camera{"ScanNet", depth_file, {}, false};
  RgbdCalibration& calibration = camera.calibration;
  const std::vector<double> of_depth = readCameraMatrix(depth_file);
  calibration.depth = lensOf(of_depth, sizes.depth_width_px, sizes.depth_height_px);
  if (!isInTheMiddle(calibration.depth)) throw ofAnotherSize(depth_file, calibration.depth);
  const auto color_file = scanNetIntrinsics(folder, "color");
  calibration.color =
      lensOf(color_file ? readCameraMatrix(*color_file) : of_depth, sizes.color_width_px, sizes.color_height_px);
  calibration.is_registered = !color_file || !isInTheMiddle(calibration.color);
  if (calibration.is_registered)
    calibration.color = lensOf(of_depth, sizes.color_width_px, sizes.color_height_px);
  else
    calibration.depth_pose = depthPose(scanNetPose(folder, "color").inverse() * scanNetPose(folder, "depth"));
  requireCamera(calibration, depth_file.string());
  if (!isInTheMiddle(calibration.color)) throw ofAnotherSize(color_file.value_or(depth_file), calibration.color);
  return camera;
}

}  // namespace

CameraFile parseOpen3dCamera(std::string_view text, const std::string& name) {
  const json object = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!object.is_object()) throw noCamera(name, "it is no JSON object");
  CameraFile camera{"Open3D", name, {}, false};
  const std::vector<double> columns = matrixOf(object, name);
  const std::vector<double> rows{columns[0], columns[3], columns[6], columns[1], columns[4],
                                 columns[7], columns[2], columns[5], columns[8]};
  camera.calibration.color = lensOf(rows, sizeOf(object, "width", name), sizeOf(object, "height", name));
  camera.has_units = object.contains("depth_scale");
  if (camera.has_units) camera.calibration.depth_units_per_m = numberOf(object, "depth_scale", name);
  requireCamera(camera.calibration, name);
  return camera;
}

std::vector<double> parseCameraMatrix(std::string_view text, const std::string& name) {
  LineReader reader = LineReader::fromBytes(text, name);
  std::vector<double> numbers;
  std::size_t side = 0, rows = 0;
  for (std::vector<Word> words; nextWords(reader, words); ++rows) {
    if (rows == 0) side = words.size();
    if (words.size() != side || (side != 3 && side != 4) || rows == side)
      throw reader.problemAt(0, "", Message("camera.no-matrix", "expected a matrix of 3 x 3 or 4 x 4 numbers"));
    for (const Word& word : words) {
      double number = 0.0;
      if (!parseNumber(word.text, number))
        throw reader.problemAt(word.column, "", Message("text.not-a-number", "`{}` is not a number", word.text));
      numbers.push_back(number);
    }
  }
  if (rows == 0 || rows != side)
    throw InputError({name}, "", Message("camera.matrix-cut", "has {} of the rows of a matrix", rows),
                     "expected 3 x 3 or 4 x 4 numbers");
  return numbers;
}

CameraFile findCameraFile(const fs::path& folder, const ImageSizes& sizes) {
  if (const auto file = firstThere(folder, {"camera_intrinsic.json", "intrinsic.json", "camera_intrinsics.json"}))
    return parseOpen3dCamera(common::readText(*file, kMostCameraBytes), file->string());
  if (sizes.color_width_px == 0) return {};
  if (const auto file = firstThere(folder, {"camera-intrinsics.txt"})) return tsdfFusionCamera(*file, sizes);
  if (const auto file = scanNetIntrinsics(folder, "depth")) return scanNetCamera(folder, *file, sizes);
  return {};
}

}  // namespace swiftlet::interfaces
