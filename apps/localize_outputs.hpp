// What `swiftlet localize` leaves: trajectory.tum, events.jsonl, map.png and report.html.
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

/// The paths that were localized without a break, thinned for drawing; map frame.
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

/// Where the robot was at a scan of the log, under the log's own stamp.
struct LocalizedScan {
  common::Time stamp;
  common::Pose2 T_map_body;
};

/// A change of state, and the scan of the log it came with, counted from 0.
struct LoggedEvent {
  common::Event event;
  std::uint64_t scan = 0;
};

/// An event for people; what came again with nothing else between is told once.
struct ToldEvent {
  std::string when;  ///< "12.300 s", or "scan 123" of a log whose stamps tell nothing.
  std::string state, reason;
  bool bad = false;
};
std::vector<ToldEvent> told(const std::vector<LoggedEvent>& events, bool has_stamps);

struct LocalizeFigures {
  std::string map, log;
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;
  std::vector<LoggedEvent> events;
  bool has_stamps = true;      ///< The log's stamps tell its scans apart.
  Spool<LocalizedScan> track;  ///< What was localized.
  LocalizedPaths paths;
  rendering::ThinnedCurve
      unexplained;  ///< Per cent of each scan while localized, over its index; the greatest of neighbours.
  rendering::ThinnedCurve milliseconds;  ///< Over the index of the scan.
};

/// Writes all files into the folder `out`. Throws InputError when one cannot be written.
void writeLocalizeOutputs(const std::filesystem::path& out, const interfaces::StoredMap& map,
                          const LocalizeFigures& figures);

}  // namespace swiftlet::apps
