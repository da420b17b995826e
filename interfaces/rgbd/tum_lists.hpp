// The lists of a folder in the format of TUM RGB-D: associations.txt, or rgb.txt and depth.txt.
#pragma once

#include <filesystem>
#include <limits>

#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::interfaces {

/// Images that make no pair.
struct Unpaired {
  /// How far apart in time the nearest two are; infinite if no two are compared.
  double nearest_s = std::numeric_limits<double>::infinity();
  double step_s = 0.0;  ///< The median of the time from one colour image to the next.
};

/// Reads associations.txt, or else the two lists, into `listing.pairs`, in the order of the stamps; the stamp of a pair
/// is that of its colour image. Stamps that number the frames (ICL-NUIM) are taken for frames at kNumberedFrames_Hz.
/// Throws InputError with file, line and column for a line that is none.
Unpaired readTumLists(const std::filesystem::path& folder, RgbdListing& listing);

}  // namespace swiftlet::interfaces
