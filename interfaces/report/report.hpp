// Reports as one HTML file each: no script, nothing loaded from elsewhere, light and dark by the reader's setting.
// Pictures come ready-made, so that this draws nothing itself.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/event.hpp"
#include "common/table.hpp"
#include "interfaces/flight_summary.hpp"

namespace swiftlet::interfaces {

/// What a flight shows beside its figures; each may be empty. An SVG is one <svg> element, put into the page as it is.
struct ReportPictures {
  std::string map_png;  ///< The bytes of a PNG: map.png of the run.
  std::string map_svg;  ///< The map of the report.
  std::vector<std::string> plots_svg;
};

/// `config_yaml` are the settings the flight used.
std::string flightReport(const FlightSummary& summary, const std::vector<common::Event>& events,
                         const ReportPictures& pictures, const std::string& config_yaml);

/// A picture of one flight of a trial.
struct TrialPicture {
  std::string caption;
  std::string file;  ///< Relative to the report: map.png of the flight's folder.
  std::string link;  ///< The flight's own report, relative.
  bool passed = true;
};

struct TrialReport {
  std::string title;
  std::string subtitle;
  bool passed = false;
  std::vector<common::Table> tables;
  std::vector<TrialPicture> pictures;
};
std::string trialReport(const TrialReport& report);

/// A map that was made of a recorded log.
struct MapReport {
  std::string title;
  std::string subtitle;
  std::vector<std::pair<std::string, std::string>> facts;  ///< Label and value.
  std::vector<std::string> warnings;                       ///< What was doubtful about the log.
  std::string map_svg;
  std::vector<std::string> plots_svg;
};
std::string mapReport(const MapReport& report);

/// A recorded log followed in a given map.
struct LocalizationReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< Label and value.
  std::vector<std::string> warnings;                       ///< What was doubtful about the log.
  common::Table events;                                    ///< What it said of itself, and when.
  std::string map_svg;
  std::vector<std::string> plots_svg;
};
std::string localizationReport(const LocalizationReport& report);

}  // namespace swiftlet::interfaces
