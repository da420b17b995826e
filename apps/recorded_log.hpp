// A recorded laser log as a subcommand takes it: its options, its scans, and what is odd about it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/swept_log.hpp"
#include "common/error.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"

namespace swiftlet::apps {

struct RecordedLogOptions {
  std::string file;
  std::string sensor;
  std::string odometry = "auto";
  std::string system = "laser_log";
  std::string out;
  bool json = false;
};

/// Adds the log, --sensor, --odometry, --system, --out and --json. `suffix` ends the name of the folder that is made
/// when none is given.
void addLogOptions(Command& command, RecordedLogOptions& options, const std::string& suffix);

/// The folder for the results. Where none is given, "logs/intel.clf.bz2" -> "intel-map".
std::filesystem::path folderFor(const RecordedLogOptions& options, const std::string& suffix);

/// "1 range", "2 ranges".
std::string plural(std::uint64_t count, const std::string& one, const std::string& more);

/// The value for JSON, or null.
template <typename Json, typename Value>
Json orNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// One thread at a time.
class RecordedLog {
 public:
  /// Throws InputError when there is no such log or sensor.
  explicit RecordedLog(const RecordedLogOptions& options);
  /// `file` is its name in messages.
  RecordedLog(std::unique_ptr<interfaces::LaserLog> log, std::string file, bool uses_odometry);

  /// nullopt at the end, also where damage ends the log: the scans before it count. Throws InputError when
  /// not a single scan came before it.
  std::optional<SweptScan> next();
  /// `logged` for SLAM and localization, without its odometry where that is not to be used. Refers to `logged`.
  perception::LaserSlamInput inputOf(const SweptScan& logged) const;

  const interfaces::LaserLog& reader() const { return swept_.reader(); }
  std::uint64_t scans() const { return scans_; }
  /// All scans so far have the same stamp, which is no time.
  bool hasOneStamp() const { return scans_ > 1 && !stamps_differ_; }
  /// Why it could not be read to its end; empty when it could.
  const std::string& damage() const { return swept_.damage(); }

  /// Why a map of it cannot be trusted, whatever the map looks like; empty if it can.
  std::string whyBent() const { return swept_.whyBent(); }

  /// Of the first record that could not be read; nullopt where all could, or the format has no lines.
  std::optional<int> firstSkippedLine() const;

  /// For people, label and value: format, scans and, if the stamps are usable, duration.
  std::vector<std::pair<std::string, std::string>> facts() const;
  /// For people: what is odd about it, with what the front end found.
  std::vector<std::string> warnings(const perception::LaserSlamCounts& found) const;
  /// `what` and what the ranges of all scans were, where no scan had points enough; with the first of the records that
  /// could not be read.
  common::InputError unusable(std::string_view what) const;

 private:
  common::Message whyNoPoints() const;

  void countStamp(common::Time stamp);
  /// What is odd about the steps of the stamps; empty if they are regular.
  std::string stampNote() const;
  void countRanges(const common::LaserScan& scan);

  std::string file_;
  bool uses_odometry_;
  SweptLog swept_;
  std::uint64_t scans_ = 0;
  std::optional<common::Time> first_stamp_;
  bool stamps_differ_ = false;
  std::vector<common::Time> first_stamps_;
  double duration_s_ = 0.0;                              ///< From the first stamp to the last.
  std::uint64_t ranges_ = 0, invalid_ = 0, beyond_ = 0;  ///< All; those without information; those without a hit.
  double nearest_m_ = 0.0, farthest_m_ = 0.0;            ///< What the laser of the last scan measures.
};

}  // namespace swiftlet::apps
