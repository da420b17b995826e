#include "interfaces/rgbd/list_rgbd.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/image_decoder.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/rgbd/camera_files.hpp"
#include "interfaces/rgbd/depth_units.hpp"
#include "interfaces/rgbd/image_folders.hpp"
#include "interfaces/rgbd/image_pairs.hpp"
#include "interfaces/rgbd/rgbd_bag.hpp"
#include "interfaces/rgbd/tum_lists.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;

constexpr const char* kKnownFormats =
    "expected associations.txt, or rgb.txt and depth.txt (TUM RGB-D), frame-000000.color.png and "
    "frame-000000.depth.png (7-Scenes, tsdf-fusion), color/ and depth/ (Open3D, Redwood, ScanNet), or a rosbag 1";
/// Images of which the size and the unit of the depths are told: of so many frames, over the whole recording.
constexpr std::size_t kSampledFrames = 8;
/// One pixel in so many of each.
constexpr std::size_t kSampledPixels = 17;

/// Whether it is there. Throws InputError where that cannot be seen.
bool isThere(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  if (failure && status.type() != fs::file_type::not_found)
    throw InputError({file.string()}, "", Message("file.not-reached", "{}", failure.message()));
  return fs::exists(status);
}

/// What of a known format is in the folder, where its other part is missing.
std::string missingPart(const fs::path& folder) {
  const auto [color, depth] = imageFoldersIn(folder);
  if (isThere(folder / "rgb.txt")) return "has rgb.txt, but no depth.txt";
  if (isThere(folder / "depth.txt")) return "has depth.txt, but no rgb.txt";
  if (color) return fmt::format("has {}/, but no depth/", color->filename().string());
  if (depth) return "has depth/, but no color/ (nor rgb/ or image/)";
  return "";
}

InputError notKnown(const fs::path& folder) {
  const std::string missing = missingPart(folder);
  if (!missing.empty())
    return InputError({folder.string()}, "", Message("rgbd.part-missing", "{}", missing), kKnownFormats);
  return InputError({folder.string()}, "", Message("rgbd.unknown-format", "holds no RGB-D frames of a known format"),
                    kKnownFormats);
}

/// Why there is not a single pair.
Message whyNoPair(const RgbdListing& listing, const Unpaired& unpaired) {
  if (listing.unpaired == 0) return Message("rgbd.no-images", "lists no images");
  Message none("rgbd.no-pair", "holds no pair of a colour and a depth image, of {} images", listing.unpaired);
  if (std::isfinite(unpaired.nearest_s))
    none += fmt::format(": the nearest two are {:.3f} s apart, at most {:g} s are one time", unpaired.nearest_s,
                        kPairedWithin_s);
  return none;
}

/// The sizes of the first images that can be read.
ImageSizes imageSizes(const RgbdListing& listing) {
  ImageSizes sizes;
  for (std::size_t i = 0; i < std::min(kSampledFrames, listing.pairs.size()); ++i) try {
      const auto color = common::decodeColor(common::readBytes(listing.pairs[i].color));
      const auto depth = common::decodeDepth(common::readBytes(listing.pairs[i].depth));
      if (color && depth) return {color->width_px, color->height_px, depth->width_px, depth->height_px};
    } catch (const InputError&) {
      continue;  // Whoever reads the frames says so.
    }
  return sizes;
}

/// Codes of some depth images, over the whole recording.
std::vector<std::uint16_t> sampledCodes(const RgbdListing& listing) {
  std::vector<std::uint16_t> codes;
  const std::size_t step = std::max<std::size_t>(1, listing.pairs.size() / kSampledFrames);
  for (std::size_t i = 0; i < listing.pairs.size(); i += step) try {
      const auto depth = common::decodeDepth(common::readBytes(listing.pairs[i].depth));
      for (std::size_t at = 0; depth && at < depth->codes.size(); at += kSampledPixels)
        codes.push_back(depth->codes[at]);
    } catch (const InputError&) {
      continue;
    }
  return codes;
}

void tellUnits(RgbdListing& listing) {
  DepthUnits units = depthUnitsOf(sampledCodes(listing), listing.calibration.depth_units_per_m);
  listing.calibration.depth_units_per_m = units.per_m;
  if (!units.note.empty()) listing.notes.push_back(std::move(units.note));
}

/// The data set has its own calibration of both cameras, whose depths are not registered. Its images come with
/// tsdf-fusion's file of the depth camera, too.
bool isOfSevenScenes(const CameraFile& camera) {
  const LensCalibration depth = sevenScenesCalibration().depth, &found = camera.calibration.color;
  return camera.format.empty() || (found.fx_px == depth.fx_px && found.fy_px == depth.fy_px &&
                                   hasShapeOf(depth, found.width_px, found.height_px));
}

/// Takes the calibration of a file; without one, that of the sensors that Open3D takes then, too. Returns whether the
/// unit of the depths is known.
bool takeCamera(const CameraFile& camera, RgbdListing& listing) {
  listing.format = camera.format.empty() ? "Open3D" : camera.format;
  listing.calibration = camera.calibration;
  if (camera.format.empty())
    listing.notes.emplace_back(
        "no file has the camera's intrinsics (camera_intrinsic.json, camera-intrinsics.txt, "
        "intrinsic/intrinsic_depth.txt): it is taken for one of 525 px focal length at 640 x 480");
  return camera.has_units;
}

struct Found {
  RgbdListing listing;
  bool has_units = false;  ///< The format or a file says how depths are stored.
  Unpaired unpaired;
};

/// Of frames whose images lie side by side.
void takeCameraOfFrames(const CameraFile& camera, Found& found) {
  if (!isOfSevenScenes(camera)) {
    found.has_units = takeCamera(camera, found.listing);
    return;
  }
  found.listing.format = "7-Scenes";
  found.listing.calibration = sevenScenesCalibration();
  found.has_units = true;
}

Found listFolder(const fs::path& folder) {
  Found found;
  RgbdListing& listing = found.listing;
  if (isThere(folder / "associations.txt") || (isThere(folder / "rgb.txt") && isThere(folder / "depth.txt"))) {
    listing.format = "TUM RGB-D";
    listing.calibration = tumCalibration();
    found.unpaired = readTumLists(folder, listing);
    return found;
  }
  listFrameFiles(folder, listing);
  if (!listing.pairs.empty() || listing.unpaired > 0) {
    takeCameraOfFrames(findCameraFile(folder, imageSizes(listing)), found);
    return found;
  }
  const auto [color, depth] = imageFoldersIn(folder);
  if (!color || !depth) throw notKnown(folder);
  listTwoFolders(*color, *depth, listing);
  if (!listing.pairs.empty()) found.has_units = takeCamera(findCameraFile(folder, imageSizes(listing)), listing);
  return found;
}

/// Throws InputError for a file that is no bag.
void requireBag(const fs::path& file) {
  constexpr std::size_t kFirstBytes = 64;
  std::string first(kFirstBytes, '\0');
  first.resize(UnpackedStream(file).read(first.data(), first.size()).value_or(0));
  if (!isBag(first))
    throw InputError({file.string()}, "", Message("rgbd.no-folder-or-bag", "is neither a folder nor a rosbag 1"),
                     "unpack an archive first");
}

Found listAny(const fs::path& recording) {
  if (!isThere(recording))
    throw InputError({recording.string()}, "", Message("rgbd.not-there", "is neither a folder nor a file"));
  if (fs::is_directory(recording)) return listFolder(recording);
  requireBag(recording);
  return {listRgbdBag(recording), true, {}};
}

/// Whether the file gives the unit of the depths.
bool readCalibration(const std::string& file, RgbdCalibration& calibration) {
  RgbdCalibration with_others = calibration;
  ++with_others.depth_units_per_m;
  common::config::YamlReader::fromFile(file).read(calibration);
  common::config::YamlReader::fromFile(file).read(with_others);
  return with_others.depth_units_per_m == calibration.depth_units_per_m;
}

}  // namespace

RgbdListing listRgbdFolder(const fs::path& recording, const std::string& calibration_file) {
  Found found = listAny(recording);
  RgbdListing& listing = found.listing;
  if (listing.pairs.empty())
    throw InputError({recording.string()}, "", whyNoPair(listing, found.unpaired),
                     stampStepNote(found.unpaired.step_s));
  const fs::path recorded = recording / "calibration.yaml";
  const bool is_recorded = calibration_file.empty() && !listing.bag && isThere(recorded);
  const std::string calibration = is_recorded ? recorded.string() : calibration_file;
  const bool are_given = !calibration.empty() && readCalibration(calibration, listing.calibration);
  if (!found.has_units && !are_given) tellUnits(listing);
  return std::move(listing);
}

}  // namespace swiftlet::interfaces
