// The results of `swiftlet localize`: trajectory.tum, events.jsonl, map.png and report.html.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "apps/map_outputs.hpp"
#include "apps/results_folder.hpp"
#include "apps/spool.hpp"
#include "common/event.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "interfaces/files/map_server.hpp"
#include "perception/localization/localizer.hpp"

namespace swiftlet::apps {

/// The paths of uninterrupted localization, thinned for drawing; map frame.
class LocalizedPaths {
 public:
  void add(const perception::LocalizationEstimate& estimate);
  const std::vector<std::vector<Eigen::Vector2d>>& paths_map_m() const { return paths_; }

 private:
  std::vector<std::vector<Eigen::Vector2d>> paths_;
  bool open_ = false;
};

inline const std::string kLocalizeTitle = "Localization of ";
inline const ResultsKind kLocalizeResults{"localization",
                                          "report.html",
                                          "<title>" + kLocalizeTitle,
                                          {"report.html", "trajectory.tum", "events.jsonl", "map.png"}};

/// The robot's pose at a scan of the log, with the log's own stamp.
struct LocalizedScan {
  common::Time stamp;
  common::Pose2 T_map_body;
};

/// A change of state, with the index of the scan at which it came.
struct LoggedEvent {
  common::Event event;
  std::uint64_t scan = 0;
};

/// An event for people. Repetitions in direct succession are merged into one.
struct ReportedEvent {
  std::string when;  ///< "12.300 s", or "scan 123" if the stamps of the log are useless.
  std::string state, reason;
  bool bad = false;
};
std::vector<ReportedEvent> reported(const std::vector<LoggedEvent>& events, bool has_stamps);

struct LocalizeFigures {
  std::string map, log;
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;
  std::vector<LoggedEvent> events;
  bool has_stamps = true;      ///< The log's stamps differ between scans.
  Spool<LocalizedScan> track;  ///< The localized scans.
  LocalizedPaths paths;
  /// Per cent of each scan over its index, while localized. Of merged scans it is the greatest.
  rendering::ThinnedCurve unexplained;
  rendering::ThinnedCurve milliseconds;  ///< Computing time over the index of the scan.
};

/// Writes all files into the folder `out`. Throws InputError if one cannot be written.
void writeLocalizeOutputs(const std::filesystem::path& out, const interfaces::StoredMap& map,
                          const LocalizeFigures& figures);

}  // namespace swiftlet::apps
