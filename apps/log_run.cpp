#include "apps/log_run.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "apps/recorded_log.hpp"
#include "evaluation/relations.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "flight/system.hpp"
#include "flight/timed_jobs.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/files/trajectory_file.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "perception/laser_odometry/sweep_motion.hpp"

namespace swiftlet::apps {
namespace {

using common::Time;

/// The scans of the part that is mapped, in the order of the log. Where the reference is in the log itself, whose
/// stamps may be useless, they are known by their place in it.
KnownScans scansOf(const SharedLog& shared) {
  const auto reader = interfaces::openLaserLog(shared.log, {});
  KnownScans scans;
  const auto most = static_cast<std::size_t>(shared.scans);
  while (most == 0 || scans.size() < most) {
    auto logged = reader->next();
    if (!logged) break;
    const Time stamp = logged->scan.stamps.measured;
    const Time known_as = shared.poses_in_log ? Time::fromSeconds(static_cast<double>(scans.size())) : stamp;
    scans.push_back({std::move(*logged), known_as});
  }
  if (scans.empty())
    throw common::InputError({shared.log}, "", common::Message("laser-log.no-scans", "no scan in it could be read"));
  return scans;
}

/// The log as if time ran the other way: its last beam comes first.
KnownScans reversed(KnownScans scans) {
  const Time first = scans.front().logged.scan.stamps.measured, last = scans.back().logged.scan.stamps.measured;
  for (KnownScan& known : scans) {
    common::LaserScan& scan = known.logged.scan;
    const Time last_beam = scan.stamps.measured + perception::sweepTime(scan);
    scan.stamps.measured = scan.stamps.arrived = first + (last - last_beam);
    scan.time_increment = common::Duration() - scan.time_increment;
  }
  std::reverse(scans.begin(), scans.end());
  return scans;
}

/// Gives scans that were read before as a log.
class ScansAsLog : public interfaces::LaserLog {
 public:
  explicit ScansAsLog(const KnownScans& scans) : scans_(scans) {}
  std::optional<interfaces::LoggedScan> next() override {
    if (counts_.scans == scans_.size()) return std::nullopt;
    return scans_[counts_.scans++].logged;
  }
  const interfaces::LaserLogCounts& counts() const override { return counts_; }
  double progress() const override {
    return static_cast<double>(counts_.scans) / static_cast<double>(std::max<std::size_t>(scans_.size(), 1));
  }
  std::string format() const override { return "scans"; }
  std::vector<std::string> notes() const override { return {}; }

 private:
  const KnownScans& scans_;
  interfaces::LaserLogCounts counts_;
};

common::Trajectory referenceOf(const SharedLog& log, const KnownScans& scans) {
  if (!log.poses_in_log) return common::ordered(interfaces::readPoses(log.poses)).trajectory;
  common::Trajectory poses;
  for (const KnownScan& scan : scans)
    if (scan.logged.T_odom_robot) poses.push_back({scan.known_as, common::lifted(*scan.logged.T_odom_robot, 0.0)});
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

std::string LogRun::part() const { return log.part() + (variation ? ", " + variation->name : ""); }

std::vector<LogRun> logRuns(const std::vector<SharedLog>& logs, bool in_variations) {
  std::vector<std::optional<LogVariation>> variations{std::nullopt};
  if (in_variations) variations.assign(logVariations().begin(), logVariations().end());
  std::vector<LogRun> runs;
  for (const SharedLog& log : logs)
    for (const auto& variation : variations)
      for (const bool backwards : {false, true}) {
        if (log.wheels) runs.push_back({log, backwards, true, variation});
        runs.push_back({log, backwards, false, variation});
      }
  return runs;
}

LogOutcome mapped(const LogRun& run, const std::string& system) {
  const KnownScans recorded = scansOf(run.log);
  KnownScans scans = run.backwards ? reversed(recorded) : recorded;
  if (run.variation) scans = varied(std::move(scans), *run.variation);
  const double begin_s = 1e-3 * flight::processorMs();
  LogMapping mapping(flight::laserSlamOf(flight::loadSystem(system)));
  RecordedLog log(std::make_unique<ScansAsLog>(scans), run.log.log, run.wheels);
  while (const auto logged = log.next()) (void)mapping.add(scans[log.scans() - 1].known_as, log.inputOf(*logged));
  mapping.finish();
  LogOutcome outcome;
  outcome.processor_s = 1e-3 * flight::processorMs() - begin_s;
  outcome.path_m = mapping.pathLength_m();
  outcome.trust = mapping.trust(log.whyBent());
  outcome.violation = mapping.judgement.violation();
  outcome.contradictions = mapping.judgement.contradicting.size();
  outcome.track = mapping.connection;
  if (run.log.isJudgedByEye()) return outcome;
  const common::Trajectory track = mapping.trajectory();
  if (run.log.relations.empty())
    compareWithPoses(referenceOf(run.log, recorded), track, outcome);
  else
    compareWithRelations(run.log, track, outcome);
  return outcome;
}

}  // namespace swiftlet::apps
