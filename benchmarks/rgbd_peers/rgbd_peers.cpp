// benchmark_rgbd_peers FOLDER [--intrinsics FILE] [--freiburg1] [--every N] [--only PART]
//
// On one recorded RGB-D folder with a reference (TUM: groundtruth.txt; 7-Scenes: the pose files), in one run and by one
// metric: our odometry, our map with pieces and loop closures, and, where OpenCV is installed, its three odometries and
// corners of it. All on one thread, on every N-th frame: without distortion, the depth registered. OpenCV is given them
// at 320 pixels of width; ours halves the recorded pictures itself, which is in its time. A frame is lost if it has no
// pose, or if it is in another piece of the map than most frames.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "benchmarks/rgbd_peers/opencv_odometry.hpp"
#include "common/config.hpp"
#include "common/error.hpp"
#include "common/median_step.hpp"
#include "common/quantile.hpp"
#include "common/table.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "tests/support/recorded_rgbd.hpp"

namespace {

using namespace swiftlet;
using common::Pose3;
using rgbd_peers::Contender;
using rgbd_peers::Peer;
using rgbd_peers::RecordedFrame;

class OurOdometry final : public Peer {
 public:
  void add(const RecordedFrame& recorded, const mapping3d::PyramidLevel&) override {
    const mapping3d::RgbdPose pose = odometry_.process(recorded.frame, std::nullopt, recorded.depth_later);
    poses_.push_back(pose.isTracked() ? std::optional(pose.T_map_camera) : std::nullopt);
  }
  std::vector<std::optional<Pose3>> finish() override { return poses_; }

 private:
  mapping3d::RgbdOdometry odometry_{mapping3d::RgbdOdometryConfig()};
  std::vector<std::optional<Pose3>> poses_;
};

/// Submaps are drawn too, which is in its time.
class OurMap final : public Peer {
 public:
  void add(const RecordedFrame& recorded, const mapping3d::PyramidLevel&) override {
    const mapping3d::MappedFrame mapped =
        mapper_.add(recorded.frame, {std::nullopt, nullptr, {}, recorded.depth_later});
    if (mapped.begun) frames_.back() = {mapped.begun->scan, Pose3()};
    for (int i = 0; i < mapped.pose.doubted; ++i) frames_[frames_.size() - 1 - static_cast<std::size_t>(i)].reset();
    frames_.emplace_back();
    if (mapped.pose.isTracked()) frames_.back() = {mapped.pose.scan, mapped.T_scan_camera};
  }
  std::vector<std::optional<Pose3>> finish() override {
    std::map<int, int> frames_of;
    for (const auto& frame : frames_)
      if (frame) ++frames_of[mapper_.pieceOf(frame->first)];
    const auto most = std::max_element(frames_of.begin(), frames_of.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    std::vector<std::optional<Pose3>> poses;
    for (const auto& frame : frames_) {
      poses.emplace_back();
      if (frame && mapper_.pieceOf(frame->first) == most->first)
        poses.back() = mapper_.scans()->T_map_level(frame->first) * frame->second;
    }
    return poses;
  }

 private:
  mapping3d::Mapper3d mapper_{mapping3d::configOfRecordings()};
  std::vector<std::optional<std::pair<int, Pose3>>> frames_;
};

/// Of the process, so that what else the machine does is not counted.
double processorSeconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Options {
  std::string folder, intrinsics, only;
  bool freiburg1 = false;
  int every = 1;  ///< One frame in this many is taken.
};

struct Result {
  std::vector<common::Time> frames;
  std::vector<double> milliseconds;
  common::Trajectory trajectory;  ///< Of the recorder's camera, which the reference is of.
};

Result run(Peer& peer, const Options& options) {
  interfaces::RgbdListing listing = interfaces::listRgbdFolder(options.folder, options.intrinsics);
  if (options.freiburg1) listing.calibration = test_support::freiburg1Calibration();
  interfaces::RgbdFolder folder(std::move(listing));
  const Pose3 T_camera_recorded = interfaces::T_camera_optical() * folder.calibration().T_recorded_color().inverse();
  Result result;
  for (int i = 0; const auto frame = folder.next(); ++i) {
    if (i % options.every != 0) continue;
    result.frames.push_back(frame->stamps.measured);
    const mapping3d::FramePyramid small = mapping3d::makePyramid(*frame, 1);
    const double begin_s = processorSeconds();
    peer.add({*frame, folder.depthLater()}, small.front());
    result.milliseconds.push_back(1e3 * (processorSeconds() - begin_s));
  }
  const auto poses = peer.finish();
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (poses[i]) result.trajectory.push_back({result.frames[i], *poses[i] * T_camera_recorded});
  return result;
}

double step_s(const common::Trajectory& poses) {
  return common::medianStep_s(poses, [](const common::StampedPose& at) { return at.stamp; });
}

/// The reference at each estimate's time plus an offset, between its neighbours: a reference of 100 Hz, taken at the
/// nearest stamp, would be up to 5 ms off, which is a quarter of a degree when the camera turns by 50 deg/s. A slow
/// reference has long steps; only what is longer than some of them is a gap.
std::vector<evaluation::PosePair> paired(const common::Trajectory& estimate, const common::Trajectory& reference,
                                         double offset_s) {
  const auto longest_gap = common::Duration::fromSeconds(std::max(0.1, 3.0 * step_s(reference)));
  std::vector<evaluation::PosePair> pairs;
  for (const common::StampedPose& at : estimate)
    if (const auto pose = common::poseAt(reference, at.stamp + common::Duration::fromSeconds(offset_s), longest_gap))
      pairs.push_back({at.stamp, at.pose, *pose});
  return pairs;
}

/// The offset in time at which the rotations from frame to frame fit best; 0 where the reference has the frames'
/// stamps, or hardly more poses than there are frames.
double bestOffset_s(const Result& result, const common::Trajectory& reference) {
  if (2.0 * step_s(reference) > common::medianStep_s(result.frames, [](common::Time stamp) { return stamp; }))
    return 0.0;
  double best_s = 0.0, least_rad = 1e9;
  for (int i = -20; i <= 20; ++i) {
    const auto pairs = paired(result.trajectory, reference, 0.002 * i);
    const double error_rad = evaluation::relativePoseError(pairs, {}).rotation_rad.rmse;
    if (pairs.size() < 2 || error_rad >= least_rad) continue;
    least_rad = error_rad;
    best_s = 0.002 * i;
  }
  return best_s;
}

std::vector<std::string> rowOf(const std::string& name, const Result& result, const common::Trajectory& reference) {
  const double offset_s = bestOffset_s(result, reference);
  const auto pairs = paired(result.trajectory, reference, offset_s);
  const auto absolute = evaluation::absoluteTrajectoryError(pairs, evaluation::Alignment::kSpatial);
  const auto frame = evaluation::relativePoseError(pairs, {});
  const auto second = evaluation::relativePoseError(pairs, {evaluation::Stretch::Unit::kSeconds, 1.0});
  const auto deg = [](double rad) { return rad / common::kRadPerDeg; };
  const auto known = [](bool is_known, double value, int digits) {
    return is_known ? fmt::format("{:.{}f}", value, digits) : "-";
  };
  const bool moved = frame.translation_m.count > 0, lasted = second.translation_m.count > 0;
  return {name,
          fmt::format("{}", result.frames.size() - result.trajectory.size()),
          fmt::format("{:.0f}", 1e3 * offset_s),
          fmt::format("{:.1f}", common::quantile(result.milliseconds, 0.5)),
          fmt::format("{:.1f}", common::quantile(result.milliseconds, 0.99)),
          absolute ? fmt::format("{:.1f}", 1e3 * absolute->translation_m.rmse) : "-",
          known(moved, 1e3 * frame.translation_m.median, 2),
          known(moved, 1e3 * frame.translation_m.rmse, 2),
          known(moved, deg(frame.rotation_rad.median), 3),
          known(moved, deg(frame.rotation_rad.rmse), 3),
          known(lasted, 1e3 * second.translation_m.rmse, 1),
          known(lasted, deg(second.rotation_rad.rmse), 2)};
}

void compare(const Options& options) {
  std::vector<Contender> contenders = {
      {"ours, odometry", [] { return std::make_unique<OurOdometry>(); }},
      {"ours, map with loops", [] { return std::make_unique<OurMap>(); }},
  };
  std::ranges::move(rgbd_peers::opencvContenders(), std::back_inserter(contenders));
  std::ranges::move(rgbd_peers::orbPnpContenders(), std::back_inserter(contenders));
  const common::Trajectory reference = test_support::recordedReference(options.folder);
  common::Table table{"",
                      {"", "lost", "offset ms", "median ms", "p99 ms", "ATE mm", "frame mm", "rms", "frame deg", "rms",
                       "1 s mm", "1 s deg"},
                      {}};
  for (const auto& [name, make] : contenders) {
    if (name.find(options.only) == std::string::npos) continue;
    const Result result = run(*make(), options);
    auto& row = table.rows.emplace_back();
    for (const std::string& cell : rowOf(name, result, reference)) row.push_back({cell});
    std::fprintf(stderr, "%s: done\n", name.c_str());
  }
  std::printf("%s", toText(table).c_str());
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--freiburg1")
      options.freiburg1 = true;
    else if (word == "--intrinsics" && i + 1 < argc)
      options.intrinsics = argv[++i];
    else if (word == "--every" && i + 1 < argc)
      options.every = std::max(1, std::atoi(argv[++i]));
    else if (word == "--only" && i + 1 < argc)
      options.only = argv[++i];
    else
      options.folder = word;
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (options.folder.empty()) {
    std::fprintf(stderr,
                 "usage: benchmark_rgbd_peers FOLDER [--intrinsics FILE] [--freiburg1] [--every N] [--only PART]\n");
    return 2;
  }
  try {
    compare(options);
  } catch (const common::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
