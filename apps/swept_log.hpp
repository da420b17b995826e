// A recorded log with the motion of the robot within each sweep, where its laser turns so slowly that this matters. For
// that it reads a few scans ahead.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interfaces/laser_log/laser_log.hpp"
#include "perception/laser_odometry/sweep_time_survey.hpp"
#include "perception/laser_odometry/sweep_tracker.hpp"

namespace swiftlet::apps {

struct SweptScan : interfaces::LoggedScan {
  std::optional<perception::SweepMotion>
      motion;  ///< nullopt where the sweep is short, or its time or motion is not known.
};

/// One thread at a time.
class SweptLog {
 public:
  explicit SweptLog(std::unique_ptr<interfaces::LaserLog> reader) : reader_(std::move(reader)) {}

  /// nullopt at the end, also where damage ends the log. Throws InputError when no scan came before the damage.
  std::optional<SweptScan> next();

  const interfaces::LaserLog& reader() const { return *reader_; }
  /// Why it could not be read to its end; empty when it could.
  const std::string& damage() const { return damage_; }

  /// For people: that the time of the sweeps is not known, and what is assumed. Empty where it is known.
  std::string unknownTime() const;
  /// Why a map of it cannot be trusted, as its sweeps could not be undone; empty if it can.
  std::string whyBent() const;

 private:
  enum class Sweeps { kShort, kUndone, kUnknown };
  Sweeps sweepsOf(const std::deque<interfaces::LoggedScan>& first);
  void readAhead();
  void begin();
  void take(const interfaces::LoggedScan& logged);

  std::unique_ptr<interfaces::LaserLog> reader_;
  std::deque<interfaces::LoggedScan> ahead_;
  bool ended_ = false;
  std::string damage_;
  std::optional<Sweeps> sweeps_;  ///< nullopt before the first scan.
  double period_s_ = 0.0;         ///< From one of the first scans to the next.
  perception::SweepTracker tracker_;
  perception::SweepTimeSurvey survey_;
};

}  // namespace swiftlet::apps
