#include "web/server/submap_feed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/rgbd_frame.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::web {
namespace {

using PointSpan = std::span<const common::SurfacePoint>;

/// Points of one message: 48 KiB, so that no message waits long behind it on a slow link.
constexpr std::size_t kPartPoints = 4096;
constexpr std::size_t kPointBytes = 12;
/// Positions are exact to half of this as long as the submap reaches no farther than 16 m; else the step is doubled.
constexpr float kLeastStep_m = 0.0005F;
constexpr float kMostSteps = 32767.0F;
/// Averaging moves a point within its cube, and cubes are smaller than this.
constexpr float kSamePoint_m = 0.05F;
/// Least period between two lists of the noisy points of the newest submap: they change often, and each list is sent
/// whole.
constexpr double kNoisyPeriod_s = 2.0;
/// Number of points that are compared to decide whether a list continues another.
constexpr std::size_t kCompared = 64;

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255U);
}

void put(std::string& bytes, double value) { put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); }

void put(std::string& bytes, const common::Pose3& pose) {
  for (const double value : {pose.position_m.x(), pose.position_m.y(), pose.position_m.z(), pose.rotation.x(),
                             pose.rotation.y(), pose.rotation.z(), pose.rotation.w()})
    put(bytes, value);
}

float stepFor(float reach_m) {
  float step_m = kLeastStep_m;
  while (reach_m > kMostSteps * step_m) step_m *= 2.0F;
  return step_m;
}

/// 0 for NaN.
std::uint32_t steps(float value, float step, float most) {
  const float count = value / step;
  return count == count ? static_cast<std::uint32_t>(std::lround(std::clamp(count, -most, most))) : 0U;
}

void put(std::string& bytes, const common::SurfacePoint& point, float step_m) {
  for (int axis = 0; axis < 3; ++axis) put(bytes, steps(point.position_m[axis], step_m, kMostSteps), 2);
  for (int axis = 0; axis < 3; ++axis) put(bytes, steps(point.normal[axis], 1.0F / 127.0F, 127.0F), 1);
  for (const std::uint8_t channel : point.rgb) put(bytes, channel, 1);
}

/// The greatest finite coordinate.
float reachOf(PointSpan points) {
  float reach_m = 0.0F;
  for (const common::SurfacePoint& point : points)
    if (point.position_m.allFinite()) reach_m = std::max(reach_m, point.position_m.cwiseAbs().maxCoeff());
  return reach_m;
}

bool continues(PointSpan next, PointSpan last) {
  if (next.size() < last.size()) return false;
  const std::size_t step = last.size() / kCompared + 1;
  for (std::size_t i = 0; i < last.size(); i += step)
    if (!((next[i].position_m - last[i].position_m).norm() < kSamePoint_m)) return false;
  return true;
}

bool samePlaces(PointSpan next, PointSpan last) {
  const auto same = [](const common::SurfacePoint& a, const common::SurfacePoint& b) {
    return a.position_m == b.position_m;
  };
  return std::equal(next.begin(), next.end(), last.begin(), last.end(), same);
}

bool isNoisy(std::size_t list) { return list % 2 == 1; }

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

void SubmapFeed::takePoints(List& known, const Points& all, PointSpan points) {
  List next{all, points, ++last_version_, last_version_, 0.0F};
  const bool same = known.all && continues(points, known.points);
  next.reach_m = std::max(same ? known.reach_m : 0.0F, reachOf(points.subspan(same ? known.points.size() : 0)));
  if (same && stepFor(next.reach_m) == stepFor(known.reach_m)) next.lineage = known.lineage;
  known = std::move(next);
}

void SubmapFeed::takeNoisy(List& known, const Points& all, PointSpan points) {
  if (!known.all || !samePlaces(points, known.points))
    known = {all, points, ++last_version_, last_version_, reachOf(points)};
  known.all = all;
  known.points = points;
}

void SubmapFeed::update(const common::Map3dLayer& map3d) {
  const auto& submaps = *map3d.submaps;
  lists_.resize(2 * submaps.size());
  std::string pose_bytes;
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    const common::Submap3d& submap = submaps[i];
    for (int list = 0; list < 2; ++list) put(pose_bytes, submap.T_map_submap(*map3d.keys));
    if (lists_[2 * i].all == submap.points) continue;
    const PointSpan all(*submap.points);
    takePoints(lists_[2 * i], submap.points, all.first(submap.fine()));
    takeNoisy(lists_[2 * i + 1], submap.points, all.last(submap.coarse));
  }
  if (!poses_ || pose_bytes != pose_bytes_) {
    pose_bytes_ = std::move(pose_bytes);
    std::string message;
    put(message, 4, 2);
    put(message, static_cast<std::uint32_t>(lists_.size()), 2);
    put(message, ++poses_version_, 4);
    poses_ = std::make_shared<const std::string>(message + pose_bytes_);
  }
  if (!map3d.frame) return;
  SharedText camera = cameraMessage(map3d);
  if (!camera_ || *camera != *camera_) camera_ = std::move(camera);
}

std::optional<SubmapReader::Transfer> SubmapReader::choose(const SubmapFeed& feed, common::Time now) {
  const auto& lists = feed.lists();
  for (std::size_t i = lists.size(); i-- > 0;) {
    Has& has = has_[i];
    if (has.lineage == 0) has = {lists[i].lineage, lists[i].version, 0};
    if (has.lineage == lists[i].lineage && has.points < lists[i].points.size())
      return Transfer{lists[i], i, has.points, true};
  }
  if (now < refresh_) return std::nullopt;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const bool settled = i + 2 < lists.size();
    if (has_[i].lineage == lists[i].lineage && !(settled && has_[i].version != lists[i].version)) continue;
    if (!settled && isNoisy(i)) {
      if (now < refresh_noisy_) continue;
      refresh_noisy_ = now + common::Duration::fromSeconds(kNoisyPeriod_s);
    }
    const double bytes = static_cast<double>(kPointBytes * lists[i].points.size());
    refresh_ = now + common::Duration::fromSeconds(bytes / kRefreshBytesPerSecond);
    has_[i] = {lists[i].lineage, lists[i].version, 0};
    return Transfer{lists[i], i, 0, false};
  }
  return std::nullopt;
}

SharedText SubmapReader::nextPart() {
  const PointSpan points = transfer_->list.points;
  const std::size_t begin = transfer_->sent, end = std::min(points.size(), begin + kPartPoints);
  const float step_m = stepFor(transfer_->list.reach_m);
  std::string bytes;
  bytes.reserve(20 + kPointBytes * (end - begin));
  put(bytes, 3, 1);
  put(bytes, transfer_->added ? 1 : 0, 1);
  put(bytes, static_cast<std::uint32_t>(transfer_->number), 2);
  put(bytes, transfer_->list.version, 4);
  put(bytes, static_cast<std::uint32_t>(begin), 4);
  put(bytes, static_cast<std::uint32_t>(points.size()), 4);
  put(bytes, static_cast<double>(step_m));
  for (std::size_t i = begin; i < end; ++i) put(bytes, points[i], step_m);
  transfer_->sent = has_[transfer_->number].points = end;
  if (end == points.size()) transfer_.reset();
  return std::make_shared<const std::string>(std::move(bytes));
}

std::vector<SharedText> SubmapReader::next(const SubmapFeed& feed, common::Time now, std::size_t most_bytes) {
  std::vector<SharedText> messages;
  if (now < asked_) refresh_ = refresh_noisy_ = now;  // The clock was set back: the refresh timers restart.
  asked_ = now;
  has_.resize(feed.lists().size());
  if (transfer_ && transfer_->number >= has_.size()) transfer_.reset();
  for (const auto& [newest, had] : {std::pair(&feed.poses(), &poses_), std::pair(&feed.camera(), &camera_)}) {
    if (!*newest || *newest == *had) continue;
    *had = *newest;
    messages.push_back(*newest);
  }
  std::size_t bytes = 0;
  while (bytes < most_bytes) {
    if (!transfer_) transfer_ = choose(feed, now);
    if (!transfer_) break;
    messages.push_back(nextPart());
    bytes += messages.back()->size();
  }
  return messages;
}

}  // namespace swiftlet::web
