// benchmark_peers LOG RELATIONS [--repeat N] [--only PART] [--settings FOLDER]
//
// On one log, in one run: our front end (LaserFrontEnd), and our SLAM without loop search, beside MRPT's icp-slam, and
// our full SLAM beside its rbpf-slam. Of each, the processor time a scan took, and how well the trajectory keeps the
// relations (Kuemmerle 2009).
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "benchmarks/peers/mrpt_peers.hpp"
#include "common/error.hpp"
#include "common/quantile.hpp"
#include "common/table.hpp"
#include "common/trajectory.hpp"
#include "evaluation/relations.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace {

using namespace swiftlet;
using common::Pose2;
using interfaces::LoggedScan;
using peers::Peer;

struct Options {
  std::string log, relations;
  int repeat = 3;
  std::string only;                                                 ///< Those whose name has this in it.
  std::filesystem::path settings = "/usr/share/mrpt/config_files";  ///< Debian's mrpt-common.
};

class OurFrontEnd final : public Peer {
 public:
  void add(const LoggedScan& logged) override {
    const auto followed = front_end_.add({logged.scan, logged.T_robot_laser, logged.T_odom_robot});
    poses_.push_back(followed ? followed->T_odom_robot : Pose2{});
  }

  std::vector<Pose2> finish() override { return poses_; }

 private:
  perception::LaserFrontEnd front_end_{test_support::laserLogFrontEnd()};
  std::vector<Pose2> poses_;
};

class OurSlam final : public Peer {
 public:
  explicit OurSlam(bool loops) : slam_(configOf(loops)), loops_(loops) {}

  void add(const LoggedScan& logged) override {
    const auto scan = slam_.add({logged.scan, logged.T_robot_laser, logged.T_odom_robot});
    track_.push_back(scan.value_or(perception::TrackedScan{}));
  }

  std::vector<Pose2> finish() override {
    if (loops_) slam_.finish();
    const std::vector<Pose2> keys = slam_.keyPoses();
    std::vector<Pose2> poses;
    for (const perception::TrackedScan& scan : track_) poses.push_back(scan.T_map_robot(keys));
    return poses;
  }

 private:
  static perception::LaserSlamConfig configOf(bool loops) {
    perception::LaserSlamConfig config = test_support::laserLogSlam();
    if (!loops) config.slam.loops.spacing_m = 1e9;
    return config;
  }
  perception::LaserSlam slam_;
  bool loops_;
  std::vector<perception::TrackedScan> track_;
};

/// Of the process, so that what else the machine does is not counted.
double processorSeconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Result {
  double total_s = 0.0;
  double median_ms = 0.0, p99_ms = 0.0;  ///< Of a scan.
  evaluation::RelationErrors errors;
};

Result runOnce(Peer& peer, const std::vector<LoggedScan>& log, bool odometry,
               const std::vector<common::Relation>& relations) {
  std::vector<double> milliseconds;
  const double begin_s = processorSeconds();
  double last_s = begin_s;
  for (LoggedScan logged : log) {
    if (!odometry) logged.T_odom_robot.reset();
    peer.add(logged);
    const double now_s = processorSeconds();
    milliseconds.push_back(1e3 * (now_s - last_s));
    last_s = now_s;
  }
  const std::vector<Pose2> poses = peer.finish();
  Result result;
  result.total_s = processorSeconds() - begin_s;
  result.median_ms = common::quantile(milliseconds, 0.5);
  result.p99_ms = common::quantile(milliseconds, 0.99);
  std::vector<common::StampedPose> track;
  for (std::size_t i = 0; i < log.size(); ++i)
    track.push_back({log[i].scan.stamps.measured, common::lifted(poses[i], 0.0)});
  result.errors = evaluation::relationErrors(common::ordered(std::move(track)).trajectory, relations);
  return result;
}

struct Contender {
  std::string name;
  bool odometry;
  std::function<std::unique_ptr<Peer>()> make;
};

/// The run of the median time; errors are the same in all of ours, and nearly so in those of the peers.
Result medianOf(const Contender& contender, const Options& options, const std::vector<LoggedScan>& log,
                const std::vector<common::Relation>& relations) {
  std::vector<Result> results;
  for (int i = 0; i < options.repeat; ++i) {
    const auto peer = contender.make();
    results.push_back(runOnce(*peer, log, contender.odometry, relations));
  }
  std::sort(results.begin(), results.end(), [](const Result& a, const Result& b) { return a.total_s < b.total_s; });
  return results[results.size() / 2];
}

void compare(const Options& options) {
  const auto reader = interfaces::openLaserLog(options.log);
  std::vector<LoggedScan> log;
  while (auto logged = reader->next()) log.push_back(std::move(*logged));
  const auto relations = interfaces::readRelations(options.relations);
  const auto icp = [&] { return peers::mrptIcpSlam(options.settings / "icp-slam" / "icp-slam_demo_classic.ini"); };
  const auto rbpf = [&] {
    return peers::mrptRbpfSlam(options.settings / "rbpf-slam" / "gridmapping_optimal_sampling.ini");
  };
  const auto front_end = [] { return std::make_unique<OurFrontEnd>(); };
  const std::vector<Contender> contenders = {
      {"front end, odometry", true, front_end},
      {"SLAM without loop search, odometry", true, [] { return std::make_unique<OurSlam>(false); }},
      {"MRPT icp-slam, odometry", true, icp},
      {"front end, no odometry", false, front_end},
      {"SLAM without loop search, no odometry", false, [] { return std::make_unique<OurSlam>(false); }},
      {"MRPT icp-slam, no odometry", false, icp},
      {"full SLAM, odometry", true, [] { return std::make_unique<OurSlam>(true); }},
      {"MRPT rbpf-slam, odometry", true, rbpf},
  };
  std::printf("%s: %zu scans, %zu relations, %d runs each\n", options.log.c_str(), log.size(), relations.size(),
              options.repeat);
  common::Table table{"", {"", "log s", "mean ms", "median ms", "p99 ms", "m", "+-", "deg", "+-"}, {}};
  for (const Contender& contender : contenders) {
    if (contender.name.find(options.only) == std::string::npos) continue;
    const Result result = medianOf(contender, options, log, relations);
    const auto& translation = result.errors.translation_m;
    const auto& rotation = result.errors.rotation_rad;
    table.rows.push_back({{contender.name},
                          {fmt::format("{:.2f}", result.total_s)},
                          {fmt::format("{:.3f}", 1e3 * result.total_s / static_cast<double>(log.size()))},
                          {fmt::format("{:.3f}", result.median_ms)},
                          {fmt::format("{:.2f}", result.p99_ms)},
                          {fmt::format("{:.4f}", translation.mean)},
                          {fmt::format("{:.4f}", translation.standard_deviation)},
                          {fmt::format("{:.3f}", rotation.mean / common::kRadPerDeg)},
                          {fmt::format("{:.3f}", rotation.standard_deviation / common::kRadPerDeg)}});
    std::fprintf(stderr, "%s: done\n", contender.name.c_str());
  }
  std::printf("%s", toText(table).c_str());
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--repeat" && i + 1 < argc)
      options.repeat = std::max(1, std::atoi(argv[++i]));
    else if (word == "--only" && i + 1 < argc)
      options.only = argv[++i];
    else if (word == "--settings" && i + 1 < argc)
      options.settings = argv[++i];
    else
      (options.log.empty() ? options.log : options.relations) = word;
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (options.relations.empty() || !std::filesystem::exists(options.settings / "icp-slam")) {
    std::fprintf(stderr,
                 "benchmark_peers LOG RELATIONS [--repeat N] [--only PART] [--settings FOLDER]\n"
                 "PART of a name, as \"front end\": the others are left out.\n"
                 "FOLDER holds MRPT's config_files; Debian's package mrpt-common brings them.\n");
    return 2;
  }
  try {
    compare(options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
