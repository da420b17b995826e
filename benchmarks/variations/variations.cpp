// benchmark_variations LOG [REFERENCE]
//
// How far the SLAM of a recorded log depends on that very log: it is run on variations of it, forwards and backwards,
// with odometry and without. REFERENCE is a file of relations (Kuemmerle 2009) or of reference poses; without one, the
// log's own poses are the reference (a corrected log) and no odometry is used. Poses are compared after alignment.
// Beside the errors stands what the SLAM itself knows: how often the track was lost, how many of its pieces nothing
// connects, and how many maps that are wrong would have been trusted.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/random.hpp"
#include "common/table.hpp"
#include "common/trajectory.hpp"
#include "evaluation/relations.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/files/trajectory_file.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "tests/slam2d/tracked_path.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace {

using namespace swiftlet;
using common::Duration;
using common::Time;

struct KnownScan {
  Time known_as;  ///< The stamp of the relations.
  interfaces::LoggedScan logged;
};
using Log = std::vector<KnownScan>;
using Variation = std::pair<std::string, std::function<void(Log&)>>;

constexpr double kWrong_m = 0.5;  ///< A map with a greater RMS error is wrong.
constexpr double kNoise_m = 0.01;
constexpr double kPeriod_s = 0.2;
constexpr double kLatest_s = 0.35;
constexpr Duration kLeastInterval = Duration::fromMilliseconds(6);

void stampAt(KnownScan& scan, Time stamp) { scan.logged.scan.stamps = {stamp, stamp}; }

/// The intervals of the log in the order of its scans, none of them back.
void stampGrowing(Log& log) {
  Time now = log.front().known_as;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (i > 0) {
      const Duration interval = log[i].known_as - log[i - 1].known_as;
      now += std::max({interval, Duration() - interval, Duration::fromMilliseconds(1)});
    }
    stampAt(log[i], now);
  }
}

void keepThose(Log& log, const std::function<bool(std::size_t)>& kept) {
  Log rest;
  for (std::size_t i = 0; i < log.size(); ++i)
    if (kept(i)) rest.push_back(std::move(log[i]));
  log = std::move(rest);
}

void addNoise(Log& log) {
  common::RandomStream random(1, "noise");
  for (KnownScan& scan : log)
    for (float& range_m : scan.logged.scan.ranges_m) range_m += static_cast<float>(kNoise_m * random.gaussian());
}

/// As if taken at an even rate and stamped when they came.
void stampLate(Log& log) {
  common::RandomStream random(1, "delays");
  Time last;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const Time late = Time::fromSeconds(kPeriod_s * static_cast<double>(i) + random.uniform(0.0, kLatest_s));
    last = i == 0 ? late : std::max(late, last + kLeastInterval);
    stampAt(log[i], last);
  }
}

std::vector<Variation> variations() {
  return {
      {"its own intervals, growing", [](Log&) {}},
      {"from the 38th scan on", [](Log& log) { keepThose(log, [](std::size_t i) { return i >= 37; }); }},
      {"without every twentieth scan", [](Log& log) { keepThose(log, [](std::size_t i) { return i % 20 != 19; }); }},
      {"every second scan", [](Log& log) { keepThose(log, [](std::size_t i) { return i % 2 == 0; }); }},
      {"1 cm of noise more", addNoise},
      {"stamped up to 0.35 s late", stampLate}};
}

/// What a trajectory is scored by: one of the two.
struct Reference {
  std::vector<common::Relation> relations;
  common::Trajectory poses;
};

Reference referenceOf(const std::string& file, const Log& log) {
  if (file.find(".relations") != std::string::npos) return {interfaces::readRelations(file), {}};
  std::vector<common::StampedPose> poses;
  if (!file.empty()) {
    poses = interfaces::readPoses(file);
  } else {
    for (const KnownScan& scan : log)
      if (scan.logged.T_odom_robot) poses.push_back({scan.known_as, common::lifted(*scan.logged.T_odom_robot, 0.0)});
  }
  return {{}, common::ordered(std::move(poses)).trajectory};
}

struct Outcome {
  evaluation::Statistics translation_m;
  std::uint64_t scans = 0, unmatched = 0;
  perception::TrackConnection track;
  perception::MapJudgement judgement;

  bool wrong() const { return !(translation_m.rmse <= kWrong_m); }
  /// As `swiftlet map` judges.
  bool trusted() const { return perception::whyNotTrusted(scans, unmatched, track, judgement).empty(); }
};

Outcome outcomeOf(const Log& log, bool odometry, const Reference& reference) {
  perception::LaserSlam slam{test_support::laserLogSlam()};
  test::TrackedPath path(slam);
  Outcome outcome;
  for (const KnownScan& scan : log) {
    const auto T_odom_robot = odometry ? scan.logged.T_odom_robot : std::nullopt;
    path.add(scan.known_as, {scan.logged.scan, scan.logged.T_robot_laser, T_odom_robot});
  }
  const common::Trajectory track = path.finish();
  if (!reference.relations.empty()) {
    outcome.translation_m = evaluation::relationErrors(track, reference.relations).translation_m;
  } else if (const auto error = evaluation::absoluteTrajectoryError(evaluation::associate(track, reference.poses),
                                                                    evaluation::Alignment::kPlanar)) {
    outcome.translation_m = error->translation_m;
  }
  outcome.scans = log.size();
  outcome.unmatched = slam.odometryCounts().failures;
  outcome.judgement = slam.judgement();
  outcome.track = slam.connection(outcome.judgement);
  return outcome;
}

void compare(const std::string& file, const std::string& reference_file) {
  const auto reader = interfaces::openLaserLog(file);
  Log forwards;
  while (auto logged = reader->next()) forwards.push_back({logged->scan.stamps.measured, *logged});
  const Reference reference = referenceOf(reference_file, forwards);
  common::Table table{"",
                      {"", "path", "odometry", "RMS m", "mean m", "at most", "lost", "bridged", "loose", "unmatched",
                       "pairs", "violation", "trusted"},
                      {}};
  int wrong_trusted = 0, right_untrusted = 0, wrong = 0;
  for (const auto& [name, vary] : variations()) {
    for (const bool backwards : {false, true}) {
      Log log = forwards;
      if (backwards) std::reverse(log.begin(), log.end());
      stampGrowing(log);
      vary(log);
      for (const bool odometry : {true, false}) {
        if (odometry && reference_file.empty()) continue;
        const Outcome outcome = outcomeOf(log, odometry, reference);
        wrong += outcome.wrong() ? 1 : 0;
        wrong_trusted += outcome.wrong() && outcome.trusted() ? 1 : 0;
        right_untrusted += !outcome.wrong() && !outcome.trusted() ? 1 : 0;
        table.rows.push_back({{name},
                              {backwards ? "back" : "on"},
                              {odometry ? "yes" : "no"},
                              {fmt::format("{:.4f}", outcome.translation_m.rmse)},
                              {fmt::format("{:.4f}", outcome.translation_m.mean)},
                              {fmt::format("{:.2f}", outcome.translation_m.max)},
                              {fmt::format("{}", outcome.track.breaks)},
                              {fmt::format("{}", outcome.track.bridged)},
                              {fmt::format("{}", outcome.track.unconnected)},
                              {fmt::format("{}", outcome.unmatched)},
                              {fmt::format("{}", outcome.judgement.pairs())},
                              {fmt::format("{:.4f}", outcome.judgement.violation())},
                              {outcome.trusted() ? "yes" : "no"}});
        std::fprintf(stderr, "%s: done\n", name.c_str());
      }
    }
  }
  std::printf("%s: %zu scans\n%s", file.c_str(), forwards.size(), toText(table).c_str());
  std::printf("%zu maps, %d wrong (RMS > %.1f m), %d of these trusted; %d right ones not trusted\n", table.rows.size(),
              wrong, kWrong_m, wrong_trusted, right_untrusted);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "benchmark_variations LOG [REFERENCE]\n");
    return 2;
  }
  try {
    compare(argv[1], argc > 2 ? argv[2] : "");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
