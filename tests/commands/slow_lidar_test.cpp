// swiftlet map and the logs of lasers that turn slowly: the sweeps are undone, in either direction of rotation; what
// the log does not say of their time is said.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/interfaces/bag_bytes.hpp"
#include "tests/scan_matching/planar_world.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace bytes = interfaces::bag_bytes;
using common::Pose2;
using test_support::describe;
using testing::HasSubstr;

/// Poses by their stamps, rounded to 0.1 ms.
using Track = std::map<std::int64_t, Pose2>;

std::int64_t keyOf(double stamp_s) { return std::llround(1e4 * stamp_s); }

Track trackIn(const std::filesystem::path& tum) {
  Track track;
  std::ifstream file(tum);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    double stamp_s = 0.0, x = 0.0, y = 0.0, z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
    if (words >> stamp_s >> x >> y >> z >> qx >> qy >> qz >> qw)
      track[keyOf(stamp_s)] = {x, y, 2.0 * std::atan2(qz, qw)};
  }
  return track;
}

struct Greatest {
  double position_m = 0.0, yaw_deg = 0.0;
};

/// Greatest errors along the track, both aligned at the first pose.
Greatest errorsOf(const Track& track, const Track& truth) {
  Greatest greatest;
  for (const auto& [stamp, pose] : track) {
    const Pose2 error =
        between(between(truth.at(track.begin()->first), truth.at(stamp)), between(track.begin()->second, pose));
    greatest.position_m = std::max(greatest.position_m, error.position_m().norm());
    greatest.yaw_deg = std::max(greatest.yaw_deg, std::abs(error.yaw_rad) / common::kRadPerDeg);
  }
  return greatest;
}

struct Lidar {
  double period_s = 0.15;
  int beams = 400;
  bool clockwise = false, upside_down = false, says_time = true, snapshots = false;
  float missing = INFINITY;
};

/// A workshop: a room with a pillar, a bench and an alcove.
test::PlanarWorld workshop() {
  test::PlanarWorld world;
  world.addPolyline({{0.0, 0.0}, {7.5, 0.0}, {7.5, 2.2}, {9.0, 2.2}, {9.0, 4.0}, {7.5, 4.0}, {7.5, 6.0}, {0.0, 6.0}},
                    true);
  world.addBox(2.0, 4.3, 0.5, 0.5, 0.4);
  world.addBox(5.6, 0.5, 1.6, 0.7);
  return world;
}

/// Turns at once, to and fro, while it drives an ellipse.
Pose2 turning(double t) {
  return {3.9 + 1.6 * std::cos(0.25 * t), 2.6 + 1.0 * std::sin(0.25 * t), 0.4 + 1.3 * std::sin(1.1 * t)};
}

struct Recording {
  std::string bag;
  Track truth;
};

Recording recordingOf(const Lidar& lidar, const std::function<Pose2(double)>& T_world_robot, int sweeps) {
  constexpr double kStart_s = 1000.0, kRangeMax_m = 12.0;
  const test::PlanarWorld world = workshop();
  common::RandomStream random(5, "slow lidar");
  const double direction = lidar.clockwise ? -1.0 : 1.0;
  const double first_rad = -direction * std::numbers::pi, step_rad = direction * 2.0 * std::numbers::pi / lidar.beams;
  const double beam_s = lidar.period_s / lidar.beams;
  std::string records = bytes::connection(0, "/scan", "sensor_msgs/LaserScan");
  Recording recording;
  for (int k = 0; k < sweeps; ++k) {
    const double begin_s = k * lidar.period_s, stamp_s = kStart_s + begin_s;
    const auto seconds = static_cast<std::uint32_t>(stamp_s);
    const auto nanoseconds = static_cast<std::uint32_t>(std::llround((stamp_s - seconds) * 1e9));
    std::string data = bytes::u32(static_cast<std::uint32_t>(k)) + bytes::u32(seconds) + bytes::u32(nanoseconds) +
                       bytes::text("laser");
    for (const double value : {first_rad, first_rad + step_rad * (lidar.beams - 1), step_rad,
                               lidar.says_time ? beam_s : 0.0, lidar.period_s, 0.15, kRangeMax_m})
      data += bytes::f32(static_cast<float>(value));
    data += bytes::u32(static_cast<std::uint32_t>(lidar.beams));
    for (int i = 0; i < lidar.beams; ++i) {
      const Pose2 pose = T_world_robot(begin_s + (lidar.snapshots ? 0.0 : i * beam_s));
      const double angle_rad = pose.yaw_rad + (lidar.upside_down ? -1.0 : 1.0) * (first_rad + i * step_rad);
      const double range_m = world.cast({pose.x_m, pose.y_m, 1.0}, {std::cos(angle_rad), std::sin(angle_rad), 0.0}) +
                             random.gaussian(0.015);
      data += bytes::f32(random.chance(0.03) ? lidar.missing : static_cast<float>(range_m));
    }
    records += bytes::message(0, seconds, data + bytes::u32(0));
    recording.truth[keyOf(stamp_s)] = T_world_robot(begin_s);
  }
  recording.bag = bytes::begin() + bytes::chunk(records);
  return recording;
}

class SlowLidar : public test_support::Scratch {
 protected:
  /// Maps the bag and returns the figures.
  nlohmann::json mapped(const std::string& bag, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", bag, "--out", path("out"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto end = test_support::runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return end.exit_code == 0 ? nlohmann::json::parse(end.out) : nlohmann::json();
  }
  void expectTrack(const Track& truth, double position_m, double yaw_deg, const std::string& what) const {
    const Track track = trackIn(path("out/trajectory.tum"));
    ASSERT_EQ(track.size(), truth.size()) << what;
    const Greatest greatest = errorsOf(track, truth);
    fmt::print("  {}: at most {:.3f} m, {:.2f} deg\n", what, greatest.position_m, greatest.yaw_deg);
    EXPECT_LE(greatest.position_m, position_m) << what;
    EXPECT_LE(greatest.yaw_deg, yaw_deg) << what;
  }
};

TEST_F(SlowLidar, SweepsAreUndoneInEitherDirection) {
  Lidar slow_clockwise{0.2, 360, true};
  slow_clockwise.missing = 0.0F;
  for (const Lidar& lidar : {Lidar{}, slow_clockwise}) {
    const Recording recording = recordingOf(lidar, turning, 80);
    const nlohmann::json figures = mapped(write("a.bag", recording.bag));
    EXPECT_TRUE(figures.at("trusted").get<bool>()) << figures.dump(2);
    expectTrack(recording.truth, 0.03, 1.0, lidar.clockwise ? "clockwise" : "counterclockwise");
  }
}

TEST_F(SlowLidar, ALaserUpsideDownIsMirrored) {
  Lidar lidar;
  lidar.upside_down = true;
  const Recording recording = recordingOf(lidar, turning, 60);
  const std::string sheet =
      write("down.yaml",
            "name: down\nbeams: 400\nfield_of_view_deg: 359.1\nrange_min_m: 0.15\nrange_max_m: 12\n"
            "mount: {x_m: 0.0, y_m: 0.0, z_m: 0.0, roll_deg: 180}\n");
  (void)mapped(write("a.bag", recording.bag), {"--sensor", sheet});
  expectTrack(recording.truth, 0.03, 1.0, "upside down");
}

TEST_F(SlowLidar, AnUnknownTimeOfTheSweepIsSaid) {
  Lidar lidar;
  lidar.says_time = false;
  const nlohmann::json swept = mapped(write("a.bag", recordingOf(lidar, turning, 80).bag));
  EXPECT_FALSE(swept.at("trusted").get<bool>());
  EXPECT_THAT(swept.at("trust_reason").get<std::string>(), HasSubstr("the time of its sweeps is not known"));
  EXPECT_THAT(swept.at("notes").dump(), HasSubstr("the time of its sweeps is not known"));
  EXPECT_THAT(test_support::readText(path("out/report.html")), HasSubstr("the time of its sweeps is not known"));
}

TEST_F(SlowLidar, RecordedSweepsAreUndone) {
  const auto folder = test_support::dataSet("10-field-cases/log_slow_lidar");
  if (!folder) return;
  // Where the robot drives through the flat, the first pose is off by 0.2 deg: 4 cm at the other end
  // (docs/decisions/logs.md#107).
  struct Log {
    std::string name;
    double position_m = 0.03;
  };
  for (const Log& log : {Log{"ccw", 0.06}, Log{"rot_17cw"}, Log{"rot_snap"}}) {
    (void)mapped((*folder / (log.name + ".bag")).string());
    expectTrack(trackIn(*folder / (log.name + ".tum")), log.position_m, 1.0, log.name);
  }
}

TEST_F(SlowLidar, ARecordedLaserUpsideDownIsMirrored) {
  const auto folder = test_support::dataSet("10-field-cases/log_upside_down");
  if (!folder) return;
  (void)mapped((*folder / "mirror.bag").string(), {"--sensor", (*folder / "rp_up.yaml").string()});
  expectTrack(trackIn(*folder / "mirror.tum"), 0.12, 1.0, "mirror");
}

}  // namespace
}  // namespace swiftlet::commands
