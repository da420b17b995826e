// A recorded laser log as input of a subcommand: its options, its scans, and its oddities.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"

namespace CLI {
class App;
}

namespace swiftlet::apps {

struct RecordedLogOptions {
  std::string file;
  std::string sensor;
  std::string odometry = "auto";
  std::string system = "laser_log";
  std::string out;
  bool json = false;
};

/// Adds the log, --sensor, --odometry, --system, --out and --json. `suffix` ends the default name of the folder.
void addLogOptions(CLI::App& command, RecordedLogOptions& options, const std::string& suffix);

/// The folder for the results. If none is given, "logs/intel.clf.bz2" -> "intel-map".
std::filesystem::path folderFor(const RecordedLogOptions& options, const std::string& suffix);

/// "1 range", "2 ranges".
std::string plural(std::uint64_t count, const std::string& one, const std::string& more);

/// The value for JSON, null if there is none.
template <typename Json, typename Value>
Json orNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// One thread at a time.
class RecordedLog {
 public:
  /// Throws InputError if there is no such log or sensor.
  explicit RecordedLog(const RecordedLogOptions& options);

  /// None at the end, also if damage ends the log: the scans before it count. Throws InputError if there was not a
  /// single scan.
  std::optional<interfaces::LoggedScan> next();
  /// Prepares `logged` for SLAM and localization; its odometry is removed if it must not be used. Refers to `logged`.
  perception::LaserSlamInput inputOf(const interfaces::LoggedScan& logged) const;

  const interfaces::LaserLog& reader() const { return *reader_; }
  std::uint64_t scans() const { return scans_; }
  /// All scans so far have the same stamp, so stamps are useless.
  bool hasOneStamp() const { return scans_ > 1 && !stamps_differ_; }
  /// Why the log could not be read to its end; empty if it could.
  const std::string& damage() const { return damage_; }

  /// The first record that could not be read; none if all could, or if the format has no lines.
  std::optional<int> firstSkippedLine() const;

  /// Facts for people, label and value: format, scans and, if the stamps are useful, duration.
  std::vector<std::pair<std::string, std::string>> facts() const;
  /// Oddities of the log for people, including those that the front end found.
  std::vector<std::string> warnings(const perception::LaserSlamCounts& found) const;
  /// An error about the whole log, with the first record that could not be read.
  common::InputError error(const std::string& message) const;

 private:
  std::string file_;
  bool uses_odometry_;
  std::unique_ptr<interfaces::LaserLog> reader_;
  std::uint64_t scans_ = 0;
  std::optional<common::Time> first_stamp_;
  bool stamps_differ_ = false;
  double duration_s_ = 0.0;  ///< Time from the first stamp to the last.
  std::string damage_;
};

}  // namespace swiftlet::apps
