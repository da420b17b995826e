#include "perception/slam2d/track_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "common/geometry.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/slam2d/map_judgement.hpp"
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

/// How certain the motion over a gap must be to connect the pieces before and after it (docs/decisions/slam.md#026): as
/// certain as the local match after the gap requires (Slam2dConfig::local_sigma_m). It is no setting: the word
/// "trusted" in a report means the same for every profile.
constexpr double kBridgeSigma_m = 0.10;
constexpr double kBridgeSigma_deg = 3.0;

/// A map is not trusted when more than one in this many scans matched nothing, or lost the track.
constexpr std::uint64_t kOneUnmatchedOf = 10;
constexpr std::uint64_t kOneLostOf = 100;

/// Mean violation (MapJudgement) of a map that is not trusted (measured: docs/decisions/slam.md#026).
constexpr double kMostViolation = 0.05;

/// Places that two pieces must have seen in common to be connected by them, and the number of places among which one
/// contradiction is allowed.
constexpr int kLeastAgreeing = 3;
constexpr int kOneContradictingOf = 5;

/// A match that this many others followed is confirmed. A surprising one, soon before the track was lost, may have been
/// the cause: the motion until then is known no better than the correction that it made to the prediction.
constexpr std::size_t kConfirming = 10;

std::string times(std::uint64_t count) { return count == 1 ? "once" : fmt::format("{} times", count); }

/// The pairs of pieces that the map connects. `member_of`: the piece of each key scan, or a number from `pieces` on.
std::vector<std::pair<std::size_t, std::size_t>> agreeingPieces(const std::vector<std::size_t>& member_of,
                                                                std::size_t pieces, const MapJudgement& judgement) {
  struct Seen {
    int agreeing = 0, contradicting = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Seen> seen;
  const auto count = [&](const std::vector<SeenTwice>& pairs, int Seen::*counted) {
    for (const SeenTwice& pair : pairs) {
      const std::size_t one = member_of.at(pair.first_key), other = member_of.at(pair.other_key);
      if (one != other && one < pieces && other < pieces) ++(seen[std::minmax(one, other)].*counted);
    }
  };
  count(judgement.agreeing, &Seen::agreeing);
  count(judgement.contradicting, &Seen::contradicting);
  std::vector<std::pair<std::size_t, std::size_t>> connected;
  for (const auto& [both, places] : seen)
    if (places.agreeing >= kLeastAgreeing && kOneContradictingOf * places.contradicting <= places.agreeing)
      connected.push_back(both);
  return connected;
}

}  // namespace

std::string whyNotTrusted(std::uint64_t scans, std::uint64_t unmatched, const TrackConnection& track,
                          const MapJudgement& judgement) {
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
  if (judgement.violation() > kMostViolation) {
    const SeenTwice& worst = judgement.contradicting.front();
    return fmt::format(
        "the map contradicts itself: of {} times that a place was seen again, {} do not agree in what is free, most of "
        "all near ({:.1f}, {:.1f})",
        judgement.pairs(), judgement.contradicting.size(), worst.at_map_m.x(), worst.at_map_m.y());
  }
  return "";
}

void TrackPieces::add(const FollowedScan& followed, std::uint64_t keys_before, std::uint64_t keys_after) {
  if (!followed.matched) gap_covariance_ += stepCovarianceOrUnknown(followed.covariance_since_last);
  if (followed.broken) {
    double sigma_m = std::sqrt(std::max(gap_covariance_(0, 0), gap_covariance_(1, 1)));
    double sigma_rad = std::sqrt(gap_covariance_(2, 2));
    for (const common::Pose2& surprise : last_matches_) {
      sigma_m = std::max(sigma_m, surprise.position_m().norm());
      sigma_rad = std::max(sigma_rad, std::abs(surprise.yaw_rad));
    }
    breaks_.push_back(
        {matched_keys_, keys_before, sigma_m <= kBridgeSigma_m && sigma_rad <= kBridgeSigma_deg * common::kRadPerDeg});
  }
  if (!followed.matched && !followed.broken) return;
  last_matches_.push_back(followed.broken ? common::Pose2{} : followed.T_expected_robot);
  if (last_matches_.size() > kConfirming) last_matches_.pop_front();
  matched_keys_ = keys_after;
  gap_covariance_.setZero();
}

TrackConnection TrackPieces::connection(std::uint64_t keys, std::span<const SlamEdge> edges,
                                        const MapJudgement& judgement) const {
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

  for (const auto& [one, other] : agreeingPieces(member_of, pieces, judgement)) groups.join(one, other);

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
