// Folders of numbered images: colours and depths side by side (7-Scenes, tsdf-fusion), or in two folders (Open3D,
// Redwood, ScanNet).
#pragma once

#include <filesystem>
#include <optional>

#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::interfaces {

/// frame-000123.color.png or .jpg and frame-000123.depth.png. Adds nothing if there are no such files.
void listFrameFiles(const std::filesystem::path& folder, RgbdListing& listing);

/// The folders of colours and of depths, whatever of their known names they have; either may be missing.
struct ImageFolders {
  std::optional<std::filesystem::path> color, depth;
};
ImageFolders imageFoldersIn(const std::filesystem::path& folder);

/// Images with the same number in their names ("0.jpg" and "0.png", "000000.jpg", "frame_12.png") are a pair, and are
/// taken for frames at kNumberedFrames_Hz. Names "0000012-000000396000.jpg" (Redwood) end with the microseconds of the
/// recording, and "1305031453.359684.png" are seconds: the nearest in time are pairs.
void listTwoFolders(const std::filesystem::path& color, const std::filesystem::path& depth, RgbdListing& listing);

}  // namespace swiftlet::interfaces
