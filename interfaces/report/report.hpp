// Reports as one HTML file each: no script, nothing loaded from elsewhere, light and dark by the reader's setting.
// Pictures come ready-made, so that this draws nothing itself.
#pragma once

#include <string>
#include <vector>

#include "common/event.hpp"
#include "common/table.hpp"
#include "interfaces/flight_summary.hpp"

namespace swiftlet::interfaces {

struct ReportPlot {
  std::string title;  ///< May be empty, where the plot carries its own.
  std::string svg;    ///< One <svg> element; put into the page as it is.
};

/// What the report of a flight shows beside its figures; each may be empty.
struct ReportPictures {
  std::string map_png;  ///< The bytes of a PNG; becomes map.png too.
  std::string map_svg;  ///< Shown instead of the PNG where there is one.
  std::vector<ReportPlot> plots;
};

/// `config_yaml` are the settings the flight used.
std::string flightReport(const FlightSummary& summary, const std::vector<common::Event>& events,
                         const ReportPictures& pictures, const std::string& config_yaml);

/// A picture of one flight of a trial.
struct TrialPicture {
  std::string caption;
  std::string file;  ///< Relative to the report: map.png of the flight's folder. Embedded if `png` is there.
  std::string png;
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

}  // namespace swiftlet::interfaces
