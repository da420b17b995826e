// benchmark_rgbd_peers FOLDER [--intrinsics FILE] [--freiburg1] [--only PART]
//
// On one recorded RGB-D folder with a reference (TUM: groundtruth.txt; 7-Scenes: the pose files), in one run and by one
// metric: our odometry, our map with loop closures, and, where OpenCV is installed, its three odometries. All on one
// thread, on the same frames: without distortion, the depth registered. OpenCV is given them at 320 pixels of width;
// ours halves the recorded pictures itself, which is in its time.
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <memory>
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

class OurOdometry final : public Peer {
 public:
  bool add(const common::RgbdFrame& frame, const mapping3d::PyramidLevel&) override {
    const mapping3d::RgbdPose pose = odometry_.process(frame);
    if (pose.isTracked()) poses_.push_back(pose.T_map_camera);
    return pose.isTracked();
  }
  std::vector<Pose3> finish() override { return poses_; }

 private:
  mapping3d::RgbdOdometry odometry_{{}};
  std::vector<Pose3> poses_;
};

/// Submaps are drawn too, which is in its time.
class OurMap final : public Peer {
 public:
  bool add(const common::RgbdFrame& frame, const mapping3d::PyramidLevel&) override {
    const mapping3d::MappedFrame mapped = mapper_.add(frame, {});
    if (mapped.pose.isTracked()) frames_.push_back({mapped.pose.scan, mapped.T_scan_camera});
    return mapped.pose.isTracked();
  }
  std::vector<Pose3> finish() override {
    std::vector<Pose3> poses;
    for (const auto& [scan, T_scan_camera] : frames_)
      poses.push_back(mapper_.scans()->T_map_level(scan) * T_scan_camera);
    return poses;
  }

 private:
  mapping3d::Mapper3d mapper_{mapping3d::Mapper3dConfig()};
  std::vector<std::pair<int, Pose3>> frames_;
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
  std::vector<common::Time> stamps;
  while (const auto frame = folder.next()) {
    result.frames.push_back(frame->stamps.measured);
    const mapping3d::FramePyramid small = mapping3d::makePyramid(*frame, 1);
    const double begin_s = processorSeconds();
    const bool placed = peer.add(*frame, small.front());
    result.milliseconds.push_back(1e3 * (processorSeconds() - begin_s));
    if (placed) stamps.push_back(frame->stamps.measured);
  }
  const std::vector<Pose3> poses = peer.finish();
  for (std::size_t i = 0; i < stamps.size(); ++i)
    result.trajectory.push_back({stamps[i], poses[i] * T_camera_recorded});
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
    std::fprintf(stderr, "usage: benchmark_rgbd_peers FOLDER [--intrinsics FILE] [--freiburg1] [--only PART]\n");
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
