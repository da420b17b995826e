// Each report is one HTML file: no script, nothing loaded from elsewhere, light or dark by the reader's setting.
// Pictures are arguments; nothing is drawn here.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/build_version.hpp"
#include "common/event.hpp"
#include "common/table.hpp"
#include "interfaces/flight_summary.hpp"

namespace swiftlet::interfaces {

/// A photograph of the mission, or a picture of a recognized object.
struct ReportPhoto {
  std::string caption;
  std::string jpeg;  ///< In base64.
};

/// The pictures of a flight; each may be empty. An SVG is one <svg> element, put into the page unchanged.
struct ReportPictures {
  std::string map_png;  ///< The bytes of a PNG: map.png of the run.
  std::string map_svg;  ///< The map of the report.
  std::vector<std::string> plots_svg;
  std::string map3d_jpeg = {};  ///< The 3D map: a JPEG in base64.
  std::vector<ReportPhoto> photos = {};
  std::vector<ReportPhoto> objects = {};  ///< Of what was recognized, drawn in.
};

/// `config_yaml` has the settings of the flight.
std::string flightReport(const FlightSummary& summary, const std::vector<common::Event>& events,
                         const ReportPictures& pictures, const std::string& config_yaml);

/// A picture of one flight of a trial.
struct TrialPicture {
  std::string caption;
  std::string file;  ///< Path relative to the report: map.png of the flight's folder.
  std::string link;  ///< Relative link to the flight's own report.
  bool passed = true;
};

struct TrialReport {
  std::string title;
  std::string subtitle;
  std::optional<bool> passed;  ///< nullopt: without criteria.
  std::vector<common::Table> tables;
  std::vector<TrialPicture> pictures;
  std::vector<std::string> plots_svg = {};  ///< Above the tables.
  common::BuildVersion version = {};
};
std::string trialReport(const TrialReport& report);

/// The report of a map made from a recorded log.
struct MapReport {
  std::string title;
  std::string subtitle;
  std::vector<std::pair<std::string, std::string>> facts;  ///< Label and value.
  std::vector<std::string> warnings;                       ///< Problems of the log.
  std::string map_svg;
  std::vector<std::string> plots_svg;
  std::string map3d_jpeg = {};  ///< The 3D map: a JPEG in base64; may be empty.
  common::BuildVersion version = {};
};
std::string mapReport(const MapReport& report);

/// The report of a recorded log that was localized in a given map.
struct LocalizationReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< Label and value.
  std::vector<std::string> warnings;                       ///< Problems of the log.
  common::Table events;                                    ///< The events of the localization with their times.
  std::string map_svg;
  std::vector<std::string> plots_svg;
  common::BuildVersion version = {};
};
std::string localizationReport(const LocalizationReport& report);

}  // namespace swiftlet::interfaces
