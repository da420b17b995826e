#include "interfaces/rgbd/rgbd_bag.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/laser_log/log_fields.hpp"
#include "interfaces/rgbd/image_messages.hpp"
#include "interfaces/rgbd/image_pairs.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using common::Time;

/// The most topics that a message lists.
constexpr std::size_t kImageTopicsListed = 8;

/// The messages of a topic, in the order of the bag.
struct ImageTopic {
  std::string name;
  ImageHeader header;  ///< Of the first message.
  std::vector<Time> stamps;
};

struct BagContents {
  std::vector<ImageTopic> images;
  std::map<std::string, CameraInfo> cameras;  ///< By topic.
  std::string all_topics;                     ///< For people.
  std::vector<std::string> notes;
};

BagReader openBag(const fs::path& file, std::function<bool(const BagConnection&)> wanted,
                  std::function<void(Message)> onProblem) {
  return {UnpackedStream(file), {std::move(wanted), kMostImageMessageBytes, std::move(onProblem)}};
}

void addImage(const BagMessage& message, BagContents& contents) {
  const auto header = imageHeader(message);
  if (!header) return;
  const std::string& topic = message.connection->topic;
  auto found = std::find_if(contents.images.begin(), contents.images.end(),
                            [&](const ImageTopic& known) { return known.name == topic; });
  if (found == contents.images.end()) found = contents.images.insert(found, {topic, *header, {}});
  found->stamps.push_back(header->stamp);
}

void addCamera(const BagMessage& message, BagContents& contents) {
  const std::string& topic = message.connection->topic;
  if (contents.cameras.contains(topic)) return;
  if (auto info = cameraInfoOf(message))
    contents.cameras.emplace(topic, *std::move(info));
  else
    contents.notes.push_back(fmt::format("{}: {}", shown(topic), info.error().text()));
}

std::string topicsOf(const BagReader& reader) {
  std::string topics;
  std::size_t listed = 0;
  for (const auto& [id, connection] : reader.connections()) {
    if (listed++ == kImageTopicsListed) return topics + ", ...";
    topics += fmt::format("{}{} ({})", topics.empty() ? "" : ", ", shown(connection.topic), shown(connection.type));
  }
  return topics.empty() ? "none" : topics;
}

BagContents contentsOf(const fs::path& file) {
  BagContents contents;
  BagReader reader = openBag(
      file,
      [](const BagConnection& connection) {
        return isImage(connection) || isCompressedImage(connection) || isCameraInfo(connection);
      },
      [&](const Message& problem) {
        if (contents.notes.size() < kImageTopicsListed) contents.notes.push_back(problem.text());
      });
  try {
    for (BagMessage message; reader.next(message);)
      isCameraInfo(*message.connection) ? addCamera(message, contents) : addImage(message, contents);
  } catch (const InputError& error) {
    contents.notes.push_back(fmt::format("the bag was read up to where it is damaged: {}", error.what()));
  }
  contents.all_topics = topicsOf(reader);
  return contents;
}

/// The topic without the name of the transport that compressed its images.
std::string plainTopic(std::string topic) {
  for (const std::string_view transport : {"/compressedDepth", "/compressed"})
    if (topic.ends_with(transport)) topic.erase(topic.size() - transport.size());
  return topic;
}

/// That of the namespace of the images, or else one of the same frame.
const CameraInfo* cameraOfTopic(const BagContents& contents, const ImageTopic& topic) {
  const std::string plain = plainTopic(topic.name);
  const auto beside = contents.cameras.find(plain.substr(0, plain.rfind('/') + 1) + "camera_info");
  if (beside != contents.cameras.end()) return &beside->second;
  for (const auto& [name, camera] : contents.cameras)
    if (!topic.header.frame.empty() && camera.frame == topic.header.frame) return &camera;
  return nullptr;
}

/// Two topics whose images may be the colours and the depths of one camera.
struct Candidate {
  const ImageTopic* color = nullptr;
  const ImageTopic* depth = nullptr;
  const CameraInfo* camera = nullptr;
  bool is_registered = false;
  std::vector<ImagePair> pairs;  ///< In the order of the stamps, as indices of sorted stamps.

  auto rank() const {
    const bool is_named_depth = depth->name.find("depth") != std::string::npos;
    const bool is_colored = color->header.kind == ImageKind::kColor;
    return std::tuple(!pairs.empty(), is_named_depth, is_registered, camera != nullptr, is_colored, pairs.size());
  }
};

/// The numbers of the messages in the order of their stamps.
std::vector<std::size_t> inOrder(const std::vector<Time>& stamps) {
  std::vector<std::size_t> order(stamps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
  return order;
}

std::vector<Time> sorted(std::vector<Time> stamps) {
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

/// Drivers that register depths to colours give both the same frame, or say so in the topic.
bool areRegistered(const ImageTopic& color, const ImageTopic& depth) {
  const auto says = [&](std::string_view word) { return depth.name.find(word) != std::string::npos; };
  return (!color.header.frame.empty() && color.header.frame == depth.header.frame) || says("registered") ||
         says("aligned");
}

std::optional<Candidate> bestOf(const BagContents& contents) {
  std::optional<Candidate> best;
  for (const ImageTopic& depth : contents.images)
    for (const ImageTopic& color : contents.images) {
      const bool shows_colors = color.header.kind == ImageKind::kColor || color.header.kind == ImageKind::kGrey;
      if (depth.header.kind != ImageKind::kDepth || !shows_colors) continue;
      Candidate candidate{&color, &depth, cameraOfTopic(contents, color), areRegistered(color, depth),
                          pairsOf(sorted(color.stamps), sorted(depth.stamps))};
      if (!best || candidate.rank() > best->rank()) best = std::move(candidate);
    }
  return best;
}

InputError notMapped(const fs::path& file, Message message, const std::string& hint) {
  return InputError({file.string()}, "", std::move(message), hint);
}

void requireUsable(const fs::path& file, const BagContents& contents, const std::optional<Candidate>& best) {
  const std::string topics = "its topics: " + contents.all_topics;
  if (!best)
    throw notMapped(file, Message("rgbd.bag-without-images", "has no two topics of colour and of depth images"),
                    topics);
  if (best->pairs.empty())
    throw notMapped(file,
                    Message("rgbd.bag-without-pairs", "no image of {} and of {} are within {:g} s of each other",
                            shown(best->color->name), shown(best->depth->name), kPairedWithin_s),
                    topics);
}

/// Depths of a camera of their own. A bag has its pose among the transforms of the robot, which are not read.
void addDepthCamera(const BagContents& contents, const Candidate& best, RgbdListing& listing) {
  if (best.is_registered) return;
  const CameraInfo* camera = cameraOfTopic(contents, *best.depth);
  listing.calibration.is_registered = camera == nullptr;
  if (camera != nullptr) listing.calibration.depth = camera->rectified;
  listing.notes.push_back(fmt::format(
      "the depths are of the frame {}, the colours of {}: both are taken for one place; record depths that are "
      "registered to the colours, or give the pose of the depth camera (--intrinsics)",
      shown(best.depth->header.frame), shown(best.color->header.frame)));
}

/// What the CameraInfo says.
void addCameras(const BagContents& contents, const Candidate& best, RgbdListing& listing) {
  if (best.depth->header.encoding.starts_with("32FC1")) listing.calibration.depth_units_per_m = kFloatUnits_per_m;
  // The distortion that the CameraInfo names is undone in a rectified image.
  const bool is_rectified = best.color->name.find("rect") != std::string::npos;
  if (best.camera != nullptr)
    listing.calibration.color = is_rectified ? best.camera->rectified : best.camera->raw;
  else
    listing.notes.emplace_back(
        "no CameraInfo belongs to the colours: the camera is taken for one of 525 px focal "
        "length at 640 x 480; give its calibration (--intrinsics)");
  addDepthCamera(contents, best, listing);
}

}  // namespace

RgbdListing listRgbdBag(const fs::path& file) {
  const BagContents contents = contentsOf(file);
  const std::optional<Candidate> best = bestOf(contents);
  requireUsable(file, contents, best);
  RgbdListing listing;
  listing.format = fmt::format("rosbag, {} and {}", shown(best->color->name), shown(best->depth->name));
  listing.notes = contents.notes;
  addCameras(contents, *best, listing);
  listing.bag = BagImages{file, best->color->name, best->depth->name};
  const std::vector<std::size_t> colors = inOrder(best->color->stamps), depths = inOrder(best->depth->stamps);
  const auto nameOf = [&](const ImageTopic& topic, std::size_t number) {
    return fs::path(fmt::format("{}: {}, image {}", file.string(), shown(topic.name), number + 1));
  };
  for (const auto& [color, depth] : best->pairs)
    listing.pairs.push_back({best->color->stamps[colors[color]], nameOf(*best->color, colors[color]),
                             nameOf(*best->depth, depths[depth]), colors[color], depths[depth],
                             best->depth->stamps[depths[depth]] - best->color->stamps[colors[color]]});
  listing.unpaired = colors.size() + depths.size() - 2 * listing.pairs.size();
  return listing;
}

struct RgbdBagImages::Kept {
  BagMessage message;
  std::string bytes;
  bool is_depth = false;
  std::size_t number = 0;
};

RgbdBagImages::RgbdBagImages(BagImages images)
    : images_(std::move(images)),
      reader_(std::make_unique<BagReader>(
          UnpackedStream(images_.file),
          BagReader::Options{[this](const BagConnection& connection) {
                               const bool is_image = isImage(connection) || isCompressedImage(connection);
                               return is_image && (connection.topic == images_.color_topic ||
                                                   connection.topic == images_.depth_topic);
                             },
                             kMostImageMessageBytes, [](const Message&) {}})) {}

RgbdBagImages::~RgbdBagImages() = default;

RgbdBagImages::Messages RgbdBagImages::of(const RgbdListing::Pair& pair) {
  forgetBefore(pair.color_message, pair.depth_message);
  while ((colors_ <= pair.color_message || depths_ <= pair.depth_message) && readOn()) {}
  return {find(false, pair.color_message), find(true, pair.depth_message)};
}

bool RgbdBagImages::readOn() {
  // Two images of a pair are written together: this many bytes between them are seconds of a large camera.
  constexpr std::size_t kMostKept = std::size_t{512} << 20;
  if (at_end_) return false;
  BagMessage message;
  try {
    at_end_ = !reader_->next(message);
  } catch (const InputError&) {
    at_end_ = true;  // The listing has the note.
  }
  if (at_end_) return false;
  if (!imageHeader(message)) return true;  // As the listing, which does not count it.
  const bool is_depth = message.connection->topic == images_.depth_topic;
  const std::size_t number = is_depth ? depths_++ : colors_++;
  kept_.push_back({message, std::string(message.data), is_depth, number});
  kept_.back().message.data = kept_.back().bytes;
  kept_bytes_ += kept_.back().bytes.size();
  while (kept_bytes_ > kMostKept && kept_.size() > 1) {
    kept_bytes_ -= kept_.front().bytes.size();
    kept_.pop_front();
  }
  return true;
}

/// Stamps may be a little out of the order of the file; a message that comes too late is missing.
void RgbdBagImages::forgetBefore(std::size_t color, std::size_t depth) {
  constexpr std::size_t kStillWanted = 8;
  while (!kept_.empty() && kept_.front().number + kStillWanted < (kept_.front().is_depth ? depth : color)) {
    kept_bytes_ -= kept_.front().bytes.size();
    kept_.pop_front();
  }
}

const BagMessage* RgbdBagImages::find(bool is_depth, std::size_t number) const {
  for (const Kept& kept : kept_)
    if (kept.is_depth == is_depth && kept.number == number) return &kept.message;
  return nullptr;
}

}  // namespace swiftlet::interfaces
