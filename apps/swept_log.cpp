#include "apps/swept_log.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/median_step.hpp"

namespace swiftlet::apps {
namespace {

using interfaces::LoggedScan;

/// In a shorter sweep no robot turns by more than about a degree before the middle of it.
constexpr double kShortSweep_s = 0.03;
/// A sweep ends when the next one begins. Stamps are not exact.
constexpr double kMostPeriods = 1.5;
/// No laser turns around in less.
constexpr double kLeastTurn_s = 0.005;
/// A laser with this wide a view turns without a stop: its sweep takes as long as the time to the next.
constexpr double kFullTurn_rad = 330.0 * common::kRadPerDeg;
/// This many scans determine the time between two of them.
constexpr std::size_t kFirstScans = 8;

}  // namespace

SweptLog::Sweeps SweptLog::sweepsOf(const std::deque<LoggedScan>& first) {
  const common::LaserScan& scan = first.front().scan;
  const double sweep_s = perception::sweepTime(scan).seconds();
  const double view_rad = scan.angle_increment_rad * static_cast<double>(scan.ranges_m.size());
  period_s_ = common::medianStep_s(first, [](const LoggedScan& logged) { return logged.scan.stamps.measured; });
  const bool slow_turn = view_rad >= kFullTurn_rad && period_s_ >= kShortSweep_s;
  if (slow_turn && (sweep_s < kLeastTurn_s || sweep_s > kMostPeriods * period_s_)) return Sweeps::kUnknown;
  if (sweep_s < kShortSweep_s || (period_s_ > 0.0 && sweep_s > kMostPeriods * period_s_)) return Sweeps::kShort;
  return Sweeps::kUndone;
}

void SweptLog::readAhead() {
  try {
    if (auto logged = reader_->next()) {
      ahead_.push_back(std::move(*logged));
      return;
    }
  } catch (const common::InputError& e) {
    if (!sweeps_ && ahead_.empty()) throw;
    damage_ = e.what();
  }
  ended_ = true;
}

void SweptLog::take(const LoggedScan& logged) {
  const common::LaserScan& scan = logged.scan;
  if (*sweeps_ == Sweeps::kUndone)
    tracker_.add(perception::sweptPoints(scan, logged.T_robot_laser), scan.stamps.measured,
                 perception::sweepTime(scan).seconds());
  else if (*sweeps_ == Sweeps::kUnknown)
    survey_.add(scan, logged.T_robot_laser, period_s_);
}

/// Reads the first scans, which determine the kind of the sweeps.
void SweptLog::begin() {
  while (!ended_ && ahead_.size() < kFirstScans) readAhead();
  if (ahead_.empty()) return;
  sweeps_ = sweepsOf(ahead_);
  for (const LoggedScan& logged : ahead_) take(logged);
  if (ended_) tracker_.finish();
}

std::optional<SweptScan> SweptLog::next() {
  if (!sweeps_) begin();
  if (!sweeps_) return std::nullopt;
  const bool undone = *sweeps_ == Sweeps::kUndone;
  const auto isReady = [&] { return undone ? tracker_.hasNext() : !ahead_.empty(); };
  while (!isReady()) {
    if (ended_) return std::nullopt;
    readAhead();
    if (ended_)
      tracker_.finish();
    else
      take(ahead_.back());
  }
  SweptScan swept{std::move(ahead_.front()), undone ? tracker_.take() : std::nullopt};
  ahead_.pop_front();
  return swept;
}

std::string SweptLog::unknownTime() const {
  if (sweeps_ != Sweeps::kUnknown) return "";
  const std::string note =
      "the time of its sweeps is not known: the time_increment of a scan is wrong or missing, and all its beams are "
      "taken to be measured at once";
  const std::optional<bool> swept = survey_.areSwept();
  if (!swept) return note + "; walls are bent if the robot moved meanwhile";
  return note + (*swept ? "" : "; as such the scans fit each other best");
}

std::string SweptLog::whyBent() const {
  if (sweeps_ != Sweeps::kUnknown || !survey_.areSwept().value_or(false)) return "";
  return fmt::format("the time of its sweeps is not known, and the scans fit each other better as sweeps of {:.2g} s",
                     period_s_);
}

}  // namespace swiftlet::apps
