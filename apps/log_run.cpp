#include "apps/log_run.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "apps/recorded_log.hpp"
#include "apps/system.hpp"
#include "apps/timed_jobs.hpp"
#include "evaluation/relations.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/files/trajectory_file.hpp"

namespace swiftlet::apps {
namespace {

using common::Time;

/// The scans of the part that is mapped, in the order of the log.
std::vector<interfaces::LoggedScan> scansOf(const SharedLog& shared) {
  RecordedLogOptions options;
  options.file = shared.log;
  RecordedLog log(options);
  std::vector<interfaces::LoggedScan> scans;
  const auto most = static_cast<std::size_t>(shared.scans);
  while (most == 0 || scans.size() < most) {
    auto logged = log.next();
    if (!logged) break;
    scans.push_back(std::move(*logged));
  }
  if (!log.damage().empty()) throw log.error(log.damage());
  return scans;
}

/// A scan of a part by its place in the log: stamps may be useless where the reference is in the log itself.
Time numbered(std::size_t index) { return Time::fromSeconds(static_cast<double>(index)); }

common::Trajectory referenceOf(const SharedLog& log, const std::vector<interfaces::LoggedScan>& scans) {
  if (!log.poses_in_log) return common::ordered(interfaces::readPoses(log.poses)).trajectory;
  common::Trajectory poses;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].T_odom_robot) poses.push_back({numbered(i), common::lifted(*scans[i].T_odom_robot, 0.0)});
  return poses;
}

double lengthOf_m(const std::vector<evaluation::PosePair>& pairs) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    length_m += (pairs[i].truth.position_m - pairs[i - 1].truth.position_m).norm();
  return length_m;
}

/// A trajectory that cannot be compared is wrong.
void compareWithRelations(const SharedLog& log, const common::Trajectory& track, LogOutcome& outcome) {
  const auto errors = evaluation::relationErrors(track, interfaces::readRelations(log.relations));
  outcome.verdict = MapVerdict::kWrong;
  if (errors.translation_m.count == 0) return;
  outcome.relations_mean_m = errors.translation_m.mean;
  outcome.relations_max_m = errors.translation_m.max;
  if (errors.translation_m.mean <= kRelationsWithin * log.best_mean_m) outcome.verdict = MapVerdict::kRight;
}

void compareWithPoses(const common::Trajectory& reference, const common::Trajectory& track, LogOutcome& outcome) {
  const std::vector<evaluation::PosePair> pairs = evaluation::associate(track, reference);
  outcome.verdict = MapVerdict::kWrong;
  const auto error = evaluation::absoluteTrajectoryError(pairs, evaluation::Alignment::kPlanar);
  if (!error) return;
  outcome.ate_rms_m = error->translation_m.rmse;
  if (*outcome.ate_rms_m <= std::max(kAteWithin_m, kAteShare * lengthOf_m(pairs))) outcome.verdict = MapVerdict::kRight;
}

}  // namespace

std::vector<LogRun> logRuns(const std::vector<SharedLog>& logs) {
  std::vector<LogRun> runs;
  for (const SharedLog& log : logs)
    for (const bool backwards : {false, true}) {
      if (log.wheels) runs.push_back({log, backwards, true});
      runs.push_back({log, backwards, false});
    }
  return runs;
}

LogOutcome mapped(const LogRun& run, const std::string& system) {
  const std::vector<interfaces::LoggedScan> scans = scansOf(run.log);
  if (scans.empty()) throw common::InputError(common::Problem{{run.log.log}, "", "no scan in it could be read", ""});
  const double begin_s = 1e-3 * processorMs();
  LogMapping mapping(laserSlamOf(loadSystem(system)));
  const Time first = scans.front().scan.stamps.measured, last = scans.back().scan.stamps.measured;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::size_t index = run.backwards ? scans.size() - 1 - i : i;
    const interfaces::LoggedScan& logged = scans[index];
    common::LaserScan scan = logged.scan;
    const Time stamp = scan.stamps.measured;
    if (run.backwards) scan.stamps.measured = scan.stamps.arrived = first + (last - stamp);
    const auto T_odom_robot = run.wheels ? logged.T_odom_robot : std::nullopt;
    (void)mapping.add(run.log.poses_in_log ? numbered(index) : stamp, {scan, logged.T_robot_laser, T_odom_robot});
  }
  mapping.finish();
  LogOutcome outcome;
  outcome.processor_s = 1e-3 * processorMs() - begin_s;
  outcome.path_m = mapping.pathLength_m();
  outcome.trust = mapping.trust();
  outcome.violation = mapping.judgement.violation();
  outcome.contradictions = mapping.judgement.contradicting.size();
  outcome.track = mapping.connection;
  if (run.log.isJudgedByEye()) return outcome;
  const common::Trajectory track = mapping.trajectory();
  if (run.log.relations.empty())
    compareWithPoses(referenceOf(run.log, scans), track, outcome);
  else
    compareWithRelations(run.log, track, outcome);
  return outcome;
}

}  // namespace swiftlet::apps
