// The RGB-D frames of a rosbag 1: which topics hold colours and depths, and their messages.
#pragma once

#include <cstddef>
#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::interfaces {

/// Reads the bag once. Of several topics, the pair is taken whose depths are registered to its colours (the same frame,
/// or a name that says so), which has a CameraInfo, and of these the one with the most pairs. Throws InputError with
/// the topics of the bag if it has no such pair, if nothing says what the camera is, or if it is no bag. A bag that is
/// cut is read up to there, with a note.
RgbdListing listRgbdBag(const std::filesystem::path& file);

/// The messages of the listed images, one after another. One thread.
class RgbdBagImages {
 public:
  explicit RgbdBagImages(BagImages images);
  ~RgbdBagImages();

  /// Those of a pair, in ascending order of the pairs. They are valid until the next call; null if they cannot be had:
  /// the bag is damaged there, or the two lie too far apart in the file.
  struct Messages {
    const BagMessage* color = nullptr;
    const BagMessage* depth = nullptr;
  };
  Messages of(const RgbdListing::Pair& pair);

 private:
  struct Kept;
  /// The next message of either topic; false at the end.
  bool readOn();
  void forgetBefore(std::size_t color, std::size_t depth);
  const BagMessage* find(bool is_depth, std::size_t number) const;

  BagImages images_;
  std::unique_ptr<BagReader> reader_;
  bool at_end_ = false;
  std::size_t colors_ = 0, depths_ = 0;  ///< Messages read so far.
  std::size_t kept_bytes_ = 0;
  std::list<Kept> kept_;
};

}  // namespace swiftlet::interfaces
