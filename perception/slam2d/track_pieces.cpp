#include "perception/slam2d/track_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "common/geometry.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/slam2d/slam_edge.hpp"

namespace swiftlet::perception {
namespace {

/// Disjoint sets (union-find).
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t of(std::size_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// A map is not trusted when more than one in this many scans matched nothing, or lost the track.
constexpr std::uint64_t kOneUnmatchedOf = 10;
constexpr std::uint64_t kOneLostOf = 100;

std::string times(std::uint64_t count) { return count == 1 ? "once" : fmt::format("{} times", count); }

}  // namespace

std::string whyNotTrusted(std::uint64_t scans, std::uint64_t unmatched, const TrackConnection& track) {
  if (track.unconnected > 0)
    return fmt::format(
        "the track was lost {}, and {} of its {} pieces, with {} key scans, {} connected to the rest neither by a loop "
        "closure nor by odometry",
        times(track.breaks), track.unconnected, track.pieces, track.unconnected_keys,
        track.unconnected == 1 ? "is" : "are");
  if (kOneUnmatchedOf * unmatched > scans)
    return fmt::format("{} of {} scans matched nothing, and stand where they were expected", unmatched, scans);
  if (kOneLostOf * track.breaks > scans)
    return fmt::format("the track was lost {} in {} scans", times(track.breaks), scans);
  return "";
}

void TrackPieces::add(const FollowedScan& followed, std::uint64_t keys_before, std::uint64_t keys_after) {
  if (!followed.matched) gap_covariance_ += stepCovarianceOrUnknown(followed.covariance_since_last);
  if (followed.broken) {
    const double sigma_m = std::sqrt(std::max(gap_covariance_(0, 0), gap_covariance_(1, 1)));
    const double sigma_rad = std::sqrt(gap_covariance_(2, 2));
    breaks_.push_back({matched_keys_, keys_before,
                       sigma_m <= config_.max_sigma_m && sigma_rad <= config_.max_sigma_deg * common::kRadPerDeg});
  }
  if (!followed.matched && !followed.broken) return;
  matched_keys_ = keys_after;
  gap_covariance_.setZero();
}

TrackConnection TrackPieces::connection(std::uint64_t keys, std::span<const SlamEdge> edges) const {
  // The members are the pieces, then the key scans. A key scan made while the track was lost is a group of its own.
  const std::size_t pieces = breaks_.size() + 1;
  Groups groups(pieces + keys);
  std::vector<std::size_t> member_of(keys);
  std::vector<std::uint64_t> keys_of_piece(pieces, 0);
  std::size_t piece = 0;
  for (std::uint64_t key = 0; key < keys; ++key) {
    while (piece < breaks_.size() && key >= breaks_[piece].first_key) ++piece;
    const bool lost = piece < breaks_.size() && key >= breaks_[piece].lost_from;
    member_of[key] = lost ? pieces + key : piece;
    if (!lost) ++keys_of_piece[piece];
  }
  TrackConnection connection;
  connection.breaks = breaks_.size();
  for (std::size_t i = 0; i < breaks_.size(); ++i) {
    if (!breaks_[i].bridged) continue;
    ++connection.bridged;
    groups.join(i, i + 1);
  }
  for (const SlamEdge& edge : edges)
    if (edge.loop)
      groups.join(member_of[static_cast<std::size_t>(edge.from)], member_of[static_cast<std::size_t>(edge.to)]);

  std::map<std::size_t, std::uint64_t> keys_of_group;
  for (std::size_t i = 0; i < pieces; ++i) keys_of_group[groups.of(i)] += keys_of_piece[i];
  const auto largest = std::max_element(keys_of_group.begin(), keys_of_group.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  connection.pieces = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    if (keys_of_piece[i] == 0) continue;
    ++connection.pieces;
    if (groups.of(i) == largest->first) continue;
    ++connection.unconnected;
    connection.unconnected_keys += keys_of_piece[i];
  }
  return connection;
}

}  // namespace swiftlet::perception
