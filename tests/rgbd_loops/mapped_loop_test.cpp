// Loops in rendered rooms: the camera goes round once, looks across the room, and comes back to where it began.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "evaluation/trajectory_metrics.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "tests/rgbd_loops/round_room.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

constexpr int kLap = 72;
constexpr double kRate_Hz = 15.0;

Pose3 onRing(double i) {
  const double part = 2.0 * std::numbers::pi * i / kLap;
  const double angle_rad = part + 0.15 * std::sin(3.0 * part);
  const double swing = 0.1 * std::sin(3.0 * angle_rad);
  return {common::quaternionFrom({0.03 * std::sin(5.0 * angle_rad), swing, angle_rad}),
          {-0.9 * std::cos(angle_rad), -0.6 * std::sin(angle_rad), swing}};
}

struct Story {
  int loops = 0;
  std::vector<int> lost;   ///< The frames.
  double error_m = 0.0;    ///< Absolute trajectory error (rmse) by the map as it is in the end.
  double error_deg = 0.0;  ///< The same of the attitude, against the first frame.
};

/// Voxels are of no interest here and take the most time.
Mapper3dConfig coarse() {
  Mapper3dConfig config;
  config.voxels.resolution_m = 0.4;
  return config;
}

template <typename Room>
std::vector<common::RgbdFrame> lap(const Room& room, int frames, double fx_factor = 1.0) {
  std::vector<common::RgbdFrame> seen;
  for (int i = 0; i < frames; ++i) {
    seen.push_back(room.seen(onRing(i), i / kRate_Hz));
    seen.back().camera.fx_px *= fx_factor;
  }
  return seen;
}

Story map(const std::vector<common::RgbdFrame>& frames, const Mapper3dConfig& config) {
  struct Tracked {
    int frame;
    int scan;
    Pose3 T_scan_camera;
  };
  Mapper3d mapper(config);
  std::vector<Tracked> tracked;
  Story story;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const MappedFrame mapped = mapper.add(frames[static_cast<std::size_t>(i)], {});
    story.loops += mapped.loops;
    if (!mapped.pose.isTracked()) story.lost.push_back(i);
    for (int k = 0; k < mapped.pose.doubted; ++k, tracked.pop_back()) story.lost.push_back(tracked.back().frame);
    if (mapped.pose.isTracked()) tracked.push_back({i, mapped.pose.scan, mapped.T_scan_camera});
  }
  std::vector<evaluation::PosePair> pairs;
  for (const Tracked& at : tracked)
    pairs.push_back({common::Time::fromSeconds(at.frame / kRate_Hz),
                     mapper.scans()->T_map_level(at.scan) * at.T_scan_camera, onRing(at.frame)});
  story.error_m = evaluation::absoluteTrajectoryError(pairs, evaluation::Alignment::kSpatial)->translation_m.rmse;
  const Pose3 T_truth_estimate = pairs.front().truth * pairs.front().estimate.inverse();
  double squares_rad2 = 0.0;
  for (const evaluation::PosePair& pair : pairs) {
    const double turn_rad = (T_truth_estimate * pair.estimate).rotation.angularDistance(pair.truth.rotation);
    squares_rad2 += turn_rad * turn_rad;
  }
  story.error_deg = std::sqrt(squares_rad2 / static_cast<double>(pairs.size())) / common::kRadPerDeg;
  return story;
}

Mapper3dConfig withoutLoops() {
  Mapper3dConfig config = coarse();
  config.loop_candidates = 0;
  return config;
}

TEST(MappedLoop, IsClosedAndCorrectsAllFramesOfIt) {
  // With intrinsics that are wrong by 2 %, every turn is measured too short.
  const RoundRoom room;
  const auto frames = lap(room, kLap, 1.02);
  const Story without = map(frames, withoutLoops()), with = map(frames, coarse());
  EXPECT_TRUE(with.lost.empty());
  EXPECT_GT(with.loops, 0);
  EXPECT_GT(without.error_deg, 3.0);
  EXPECT_LT(with.error_deg, 0.2 * without.error_deg);
}

TEST(MappedLoop, LostAlongABlankWallItIsFoundAgainWhereItWasBefore) {
  RoundRoom room;
  room.blank_from_rad = 2.0;
  room.blank_to_rad = 4.0;
  const Story story = map(lap(room, kLap + 4), coarse());
  ASSERT_GT(story.lost.size(), 20u);
  EXPECT_LT(*std::max_element(story.lost.begin(), story.lost.end()), kLap - 4) << "it is back where it began";
  EXPECT_LT(story.error_m, 0.01);
}

TEST(MappedLoop, APlaceThatLooksLikeAnotherIsNotTakenForIt) {
  TexturedRoom room;
  room.is_symmetric = true;
  const auto frames = lap(room, kLap / 2 + 6);
  Mapper3dConfig unchecked = coarse();
  unchecked.graph.drift_m = unchecked.graph.drift_rad = 100.0;
  unchecked.graph.greatest_error = 1e6;
  unchecked.graph.optimization.robust_width = 100.0;
  const Story with = map(frames, coarse()), bent = map(frames, unchecked);
  EXPECT_EQ(with.loops, 0);
  EXPECT_LT(with.error_m, 0.03);
  EXPECT_GT(bent.loops, 0) << "the check matters";
  EXPECT_GT(bent.error_m, 0.2) << "the check matters";
}

Mapper3dConfig inPieces() {
  Mapper3dConfig config = coarse();
  config.odometry.begins_pieces = true;
  return config;
}

/// The camera is carried across the room in the dark, goes on where it never was, and comes back to where it began.
TEST(Pieces, AreJoinedWhereTheyMeetAgain) {
  const RoundRoom room;
  std::vector<common::RgbdFrame> frames;
  std::vector<int> shown;
  for (int i = 0; i < 20; ++i) shown.push_back(i);
  for (int i = 40; i < kLap + 16; ++i) shown.push_back(i);
  Mapper3d mapper(inPieces());
  std::vector<evaluation::PosePair> pairs;
  struct Tracked {
    int place, scan;
    Pose3 T_scan_camera;
  };
  std::vector<Tracked> tracked;
  int lost = 0, pieces_before = 1;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const MappedFrame mapped = mapper.add(room.seen(onRing(shown[k]), static_cast<double>(k) / kRate_Hz), {});
    if (mapped.begun) tracked.push_back({shown[k - 1], mapped.begun->scan, {}});
    if (mapped.pose.isTracked()) tracked.push_back({shown[k], mapped.pose.scan, mapped.T_scan_camera});
    lost += mapped.pose.isTracked() ? 0 : 1;
    if (shown[k] == kLap - 12) pieces_before = mapper.pieceOf(mapped.pose.scan);
  }
  EXPECT_EQ(lost, 1) << "the frame with which the piece begins";
  EXPECT_EQ(tracked.size(), shown.size()) << "which gets a pose by the next one";
  EXPECT_EQ(pieces_before, 1) << "of its own, before it is where it began";
  for (const Tracked& at : tracked) {
    EXPECT_EQ(mapper.pieceOf(at.scan), 0) << at.place;
    pairs.push_back({common::Time::fromSeconds(at.place / kRate_Hz),
                     mapper.scans()->T_map_level(at.scan) * at.T_scan_camera, onRing(at.place)});
  }
  EXPECT_LT(evaluation::absoluteTrajectoryError(pairs, evaluation::Alignment::kSpatial)->translation_m.rmse, 0.03);
}

/// A room that was never seen before and is left for good.
TEST(Pieces, ThatNeverMeetStayApart) {
  RoundRoom elsewhere;
  elsewhere.walls = 100;
  elsewhere.radius_m = 1.6;
  Mapper3d mapper(inPieces());
  std::vector<int> pieces;
  for (int i = 0; i < 30; ++i) {
    const bool is_there = i >= 10 && i < 20;
    const double at = i < 10 ? i : i - 10;
    const MappedFrame mapped = mapper.add(
        is_there ? elsewhere.seen(onRing(0.3 * i), i / kRate_Hz) : RoundRoom().seen(onRing(at), i / kRate_Hz), {});
    pieces.push_back(mapped.pose.isTracked() ? mapper.pieceOf(mapped.pose.scan) : -1);
  }
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(pieces[static_cast<std::size_t>(i)], i < 10 || i >= 20 ? 0 : i == 10 ? -1 : 1) << i;
}

TEST(FiveHertz, WhatCannotBeTrackedIsLostAndFoundAgain) {
  // Steps of up to 10 cm and 6 degrees, with the settings of all other tests; the camera is covered for two seconds.
  RoundRoom elsewhere;
  elsewhere.walls = 100;
  elsewhere.radius_m = 1.6;
  std::vector<common::RgbdFrame> frames;
  for (int i = 0; i < kLap; ++i) {
    const bool is_covered = i >= 40 && i < 50;
    frames.push_back(is_covered ? elsewhere.seen({}, i / 5.0) : RoundRoom().seen(onRing(i < 40 ? i : 78 - i), i / 5.0));
  }
  const Story story = map(frames, coarse());
  EXPECT_THAT(story.lost, testing::ElementsAre(40, 41, 42, 43, 44, 45, 46, 47, 48, 49));
}

TEST(FocalCheck, NoticesAFocalLengthThatIsWrongByAQuarterAndMore) {
  for (const double factor : {1.0, 1.25, 1.55}) {
    Mapper3d mapper(coarse());
    EXPECT_FALSE(mapper.isFocalLengthChecked());
    for (common::RgbdFrame frame : lap(RoundRoom(), kLap / 2)) {
      frame.camera.fx_px *= factor;
      frame.camera.fy_px *= factor;
      (void)mapper.add(frame, {});
    }
    EXPECT_TRUE(mapper.isFocalLengthChecked()) << factor;
    EXPECT_EQ(mapper.betterFocalFactor().has_value(), factor != 1.0) << factor;
    EXPECT_LE(mapper.betterFocalFactor().value_or(1.0), 1.0);
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
