#include "web/server/submap_feed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::web {
namespace {

using Eigen::Vector3f;

/// Points of one message: 48 KiB, so that nothing waits long behind it on a slow link.
constexpr std::size_t kPartPoints = 4096;
constexpr float kSteps = 65535.0F;

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255U);
}

void put(std::string& bytes, double value) { put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); }

void put(std::string& bytes, const common::Pose3& pose) {
  for (const double value : {pose.position_m.x(), pose.position_m.y(), pose.position_m.z(), pose.rotation.x(),
                             pose.rotation.y(), pose.rotation.z(), pose.rotation.w()})
    put(bytes, value);
}

/// Positions as steps from the lower corner of a box.
struct Quantized {
  Vector3f origin_m = Vector3f::Zero();
  float step_m = 1.0F;

  explicit Quantized(const std::vector<common::SurfacePoint>& points) {
    Eigen::AlignedBox3f box;
    for (const common::SurfacePoint& point : points)
      if (point.position_m.allFinite()) box.extend(point.position_m);
    if (box.isEmpty()) return;
    origin_m = box.min();
    step_m = std::max(1e-6F, box.sizes().maxCoeff() / kSteps);
  }
  std::uint32_t steps(const Vector3f& position_m, int axis) const {
    const float steps = (position_m[axis] - origin_m[axis]) / step_m;
    return steps > 0.0F ? static_cast<std::uint32_t>(std::min(kSteps, std::round(steps))) : 0;
  }
};

/// 0 for NaN.
long normalStep(float component) {
  return component >= -1.0F && component <= 1.0F ? std::lround(127.0F * component) : 0;
}

void put(std::string& bytes, const common::SurfacePoint& point, const Quantized& quantized) {
  for (int axis = 0; axis < 3; ++axis) put(bytes, quantized.steps(point.position_m, axis), 2);
  for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<std::uint32_t>(normalStep(point.normal[axis])), 1);
  for (const std::uint8_t channel : point.rgb) put(bytes, channel, 1);
}

std::vector<SharedText> partsOf(std::size_t submap, const SubmapFeed::Entry& entry) {
  const auto& points = *entry.points;
  const Quantized quantized(points);
  std::vector<SharedText> parts;
  std::size_t begin = 0;
  do {
    const std::size_t end = std::min(points.size(), begin + kPartPoints);
    std::string bytes;
    bytes.reserve(32 + 12 * (end - begin));
    put(bytes, 3, 2);
    put(bytes, static_cast<std::uint32_t>(submap), 2);
    put(bytes, entry.version, 4);
    put(bytes, static_cast<std::uint32_t>(begin), 4);
    put(bytes, static_cast<std::uint32_t>(points.size()), 4);
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<double>(quantized.origin_m[axis]));
    put(bytes, static_cast<double>(quantized.step_m));
    for (; begin < end; ++begin) put(bytes, points[begin], quantized);
    parts.push_back(std::make_shared<const std::string>(std::move(bytes)));
  } while (begin < points.size());
  return parts;
}

SharedText cameraMessage(const common::Map3dLayer& map3d) {
  const common::PinholeCamera& lens = map3d.frame->camera;
  std::string bytes;
  put(bytes, 5, 1);
  put(bytes, map3d.tracked ? 1 : 0, 3);
  put(bytes, map3d.T_map_camera);
  put(bytes, 0.5 * lens.width_px / lens.fx_px);
  put(bytes, 0.5 * lens.height_px / lens.fy_px);
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace

void SubmapFeed::update(const common::Map3dLayer& map3d) {
  const auto& submaps = *map3d.submaps;
  entries_.resize(submaps.size());
  std::string pose_bytes;
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    if (entries_[i].points != submaps[i].points) entries_[i] = {submaps[i].points, ++last_version_, {}};
    put(pose_bytes, submaps[i].T_map_submap(*map3d.keys));
  }
  if (!poses_ || pose_bytes != pose_bytes_) {
    pose_bytes_ = std::move(pose_bytes);
    std::string message;
    put(message, 4, 2);
    put(message, static_cast<std::uint32_t>(submaps.size()), 2);
    put(message, ++poses_version_, 4);
    poses_ = std::make_shared<const std::string>(message + pose_bytes_);
  }
  if (!map3d.frame) return;
  SharedText camera = cameraMessage(map3d);
  if (!camera_ || *camera != *camera_) camera_ = std::move(camera);
}

const std::vector<SharedText>& SubmapFeed::encoded(std::size_t submap) const {
  Entry& entry = entries_[submap];
  if (entry.parts.empty()) entry.parts = partsOf(submap, entry);
  return entry.parts;
}

std::optional<std::size_t> SubmapReader::choose(const SubmapFeed& feed, common::Time now) const {
  for (std::size_t i = feed.size(); i-- > 0;)
    if (versions_[i] == 0) return i;
  if (now < refresh_) return std::nullopt;
  // The oldest first, or one that changes with every frame would keep the others waiting for ever.
  for (std::size_t i = 0; i < feed.size(); ++i)
    if (versions_[i] != feed.version(i)) return i;
  return std::nullopt;
}

bool SubmapReader::begin(const SubmapFeed& feed, common::Time now) {
  const auto submap = choose(feed, now);
  if (!submap) return false;
  const std::vector<SharedText>& parts = feed.encoded(*submap);
  sending_.assign(parts.rbegin(), parts.rend());
  std::size_t bytes = 0;
  for (const SharedText& part : parts) bytes += part->size();
  refresh_ = now + common::Duration::fromSeconds(static_cast<double>(bytes) / kRefreshBytesPerSecond);
  versions_[*submap] = feed.version(*submap);
  return true;
}

std::vector<SharedText> SubmapReader::next(const SubmapFeed& feed, common::Time now, std::size_t most_bytes) {
  std::vector<SharedText> messages;
  versions_.resize(feed.size());
  for (const auto& [newest, had] : {std::pair(&feed.poses(), &poses_), std::pair(&feed.camera(), &camera_)}) {
    if (!*newest || *newest == *had) continue;
    *had = *newest;
    messages.push_back(*newest);
  }
  std::size_t bytes = 0;
  while (bytes < most_bytes && (!sending_.empty() || begin(feed, now))) {
    bytes += sending_.back()->size();
    messages.push_back(std::move(sending_.back()));
    sending_.pop_back();
  }
  return messages;
}

}  // namespace swiftlet::web
