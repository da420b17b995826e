// benchmark_variations LOG RELATIONS
//
// How far the SLAM of a recorded log depends on that very log: it is run on variations of it, forwards and backwards,
// with odometry and without, and each trajectory is scored by the same relations (Kuemmerle 2009).
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
#include "interfaces/files/relations.hpp"
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

evaluation::RelationErrors errorsOf(const Log& log, bool odometry, const std::vector<common::Relation>& relations) {
  perception::LaserSlam slam{test_support::laserLogSlam()};
  test::TrackedPath way(slam);
  for (const KnownScan& scan : log) {
    const auto T_odom_robot = odometry ? scan.logged.T_odom_robot : std::nullopt;
    way.add(scan.known_as, {scan.logged.scan, scan.logged.T_robot_laser, T_odom_robot});
  }
  return evaluation::relationErrors(way.finish(), relations);
}

void compare(const std::string& file, const std::string& relations_file) {
  const auto reader = interfaces::openLaserLog(file);
  Log forwards;
  while (auto logged = reader->next()) forwards.push_back({logged->scan.stamps.measured, *logged});
  const auto relations = interfaces::readRelations(relations_file);
  common::Table table{"", {"", "way", "odometry", "m", "at most", "deg"}, {}};
  for (const auto& [name, vary] : variations()) {
    for (const bool backwards : {false, true}) {
      Log log = forwards;
      if (backwards) std::reverse(log.begin(), log.end());
      stampGrowing(log);
      vary(log);
      for (const bool odometry : {true, false}) {
        const evaluation::RelationErrors errors = errorsOf(log, odometry, relations);
        table.rows.push_back({{name},
                              {backwards ? "back" : "on"},
                              {odometry ? "yes" : "no"},
                              {fmt::format("{:.4f}", errors.translation_m.mean)},
                              {fmt::format("{:.2f}", errors.translation_m.max)},
                              {fmt::format("{:.3f}", errors.rotation_rad.mean / common::kRadPerDeg)}});
        std::fprintf(stderr, "%s: done\n", name.c_str());
      }
    }
  }
  std::printf("%s: %zu scans, %zu relations\n%s", file.c_str(), forwards.size(), relations.size(),
              toText(table).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "benchmark_variations LOG RELATIONS\n");
    return 2;
  }
  try {
    compare(argv[1], argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
