// Which pieces of a track are connected, scan by scan.
#include "perception/slam2d/track_pieces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/slam2d/map_judgement.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::perception {
namespace {

using testing::HasSubstr;

enum class Seen { kMatched, kNothing, kLostAndBegunAnew };

/// A track of which each scan is a key scan.
class Track {
 public:
  void scans(int count, Seen seen, double sigma_m = 0.01, const common::Pose2& T_expected_robot = {}) {
    for (int i = 0; i < count; ++i) {
      FollowedScan followed;
      followed.matched = seen == Seen::kMatched;
      followed.broken = seen == Seen::kLostAndBegunAnew;
      followed.T_expected_robot = T_expected_robot;
      followed.covariance_since_last = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
      pieces_.add(followed, keys_, keys_ + 1);
      ++keys_;
    }
  }
  /// Four scans match nothing; the odometry restarts at the fourth.
  void lose(double sigma_m = 1.0) {
    scans(3, Seen::kNothing, sigma_m);
    scans(1, Seen::kLostAndBegunAnew, sigma_m);
  }
  void edge(int from, int to, bool loop) {
    SlamEdge edge;
    edge.from = from;
    edge.to = to;
    edge.loop = loop;
    edges_.push_back(edge);
  }
  TrackConnection connection(const MapJudgement& map = {}) const { return pieces_.connection(keys_, edges_, map); }
  int last() const { return static_cast<int>(keys_) - 1; }

 private:
  TrackPieces pieces_;
  std::uint64_t keys_ = 0;
  std::vector<SlamEdge> edges_;
};

/// A corridor that fits 64 deg beside the prediction, and nothing after it: the match was the error.
TEST(TrackPieces, AMatchThatSurprisedJustBeforeALossIsNotConfirmed) {
  const common::Pose2 turned{0.1, 0.0, 1.1};
  Track doubted, confirmed;
  for (Track* track : {&doubted, &confirmed}) {
    track->scans(20, Seen::kMatched);
    track->scans(1, Seen::kMatched, 0.01, turned);
    track->scans(track == &doubted ? 2 : 12, Seen::kMatched);
    track->lose(0.01);
    track->scans(20, Seen::kMatched);
  }
  EXPECT_EQ(doubted.connection().bridged, 0U);
  EXPECT_EQ(confirmed.connection().bridged, 1U);
}

TEST(TrackPieces, ATrackThatWasNeverLostIsOnePiece) {
  Track track;
  EXPECT_EQ(track.connection().unconnected, 0U);
  track.scans(10, Seen::kMatched);
  track.scans(3, Seen::kNothing);
  track.scans(10, Seen::kMatched);
  const TrackConnection connection = track.connection();
  EXPECT_EQ(connection.breaks, 0U);
  EXPECT_EQ(connection.pieces, 1U);
  EXPECT_EQ(connection.unconnected, 0U);
  EXPECT_EQ(whyNotTrusted(23, 3, connection, {}), "3 of 23 scans matched nothing, and stand where they were expected");
  EXPECT_EQ(whyNotTrusted(100, 3, connection, {}), "");
}

TEST(TrackPieces, ALoopClosureConnectsALostTrack) {
  Track track;
  track.scans(50, Seen::kMatched);
  track.lose();
  track.scans(20, Seen::kMatched);
  track.edge(49, 53, false);  // The guess over the gap.
  TrackConnection connection = track.connection();
  EXPECT_EQ(connection.breaks, 1U);
  EXPECT_EQ(connection.pieces, 2U);
  EXPECT_EQ(connection.unconnected, 1U);
  EXPECT_EQ(connection.unconnected_keys, 21U);
  EXPECT_THAT(whyNotTrusted(1000, 4, connection, {}),
              HasSubstr("lost once, and 1 of its 2 pieces, with 21 key scans, is"));
  track.edge(60, 65, true);
  EXPECT_EQ(track.connection().unconnected, 1U) << "a loop within the new piece";
  track.edge(51, 65, true);
  EXPECT_EQ(track.connection().unconnected, 1U) << "to a scan that matched nothing";
  track.edge(10, track.last(), true);
  EXPECT_EQ(track.connection().unconnected, 0U);
  EXPECT_EQ(whyNotTrusted(1000, 4, track.connection(), {}), "");
}

TEST(TrackPieces, PiecesMayBeConnectedThroughOthers) {
  Track track;
  track.scans(30, Seen::kMatched);
  track.lose();
  track.scans(30, Seen::kMatched);  // Key scans 33 to 63.
  track.lose();
  track.scans(30, Seen::kMatched);  // From 67 on.
  EXPECT_EQ(track.connection().unconnected, 2U);
  track.edge(40, 80, true);
  EXPECT_EQ(track.connection().unconnected, 1U) << "the first piece is the smaller part now";
  EXPECT_EQ(track.connection().unconnected_keys, 30U);
  track.edge(5, 80, true);
  EXPECT_EQ(track.connection().unconnected, 0U);
}

TEST(TrackPieces, AccurateOdometryConnectsAcrossAGap) {
  for (const auto& [sigma_m, unconnected] : {std::pair{0.02, 0U}, std::pair{0.2, 1U}}) {
    Track track;
    track.scans(30, Seen::kMatched);
    track.lose(sigma_m);
    track.scans(30, Seen::kMatched);
    EXPECT_EQ(track.connection().unconnected, unconnected) << sigma_m;
    EXPECT_EQ(track.connection().bridged, 1U - unconnected) << sigma_m;
  }
}

TEST(TrackPieces, TheMapConnectsPiecesThatAgreeInSeveralPlaces) {
  Track track;
  track.scans(50, Seen::kMatched);
  track.lose();
  track.scans(50, Seen::kMatched);  // Key scans 53 to 103.
  MapJudgement map;
  map.agreeing = {{0, 60}, {12, 60}};
  EXPECT_EQ(track.connection(map).unconnected, 1U) << "two may agree by chance";
  map.agreeing.push_back({24, 72});
  map.agreeing.push_back({0, 24});
  EXPECT_EQ(track.connection(map).unconnected, 0U);
  map.contradicting = {{12, 84, 0.3}};
  EXPECT_EQ(track.connection(map).unconnected, 1U);
}

TEST(TrackPieces, AMapThatContradictsItselfIsNotTrusted) {
  MapJudgement map;
  map.agreeing.resize(18);
  map.contradicting = {{0, 60, 0.4, {3.0, -2.5}}, {12, 72, 0.3}};
  EXPECT_EQ(whyNotTrusted(1000, 0, {}, map), "") << "a door that was moved";
  map.agreeing.resize(8);
  EXPECT_EQ(whyNotTrusted(1000, 0, {}, map),
            "the map contradicts itself: of 10 times that a place was seen again, 2 do not agree in what is free, most "
            "of all near (3.0, -2.5)");
}

TEST(TrackPieces, AMapWithFewMatchedScansIsNotTrusted) {
  EXPECT_THAT(whyNotTrusted(30, 29, {}, {}), HasSubstr("29 of 30 scans matched nothing"));
  TrackConnection often;
  often.breaks = often.bridged = 11;
  often.pieces = 12;
  EXPECT_EQ(whyNotTrusted(1100, 44, often, {}), "");
  EXPECT_EQ(whyNotTrusted(1000, 44, often, {}), "the track was lost 11 times in 1000 scans");
}

}  // namespace
}  // namespace swiftlet::perception
