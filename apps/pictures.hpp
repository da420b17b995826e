// The map and the plots of a run's report, drawn from the data so far.
#pragma once

#include "common/trajectory.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::apps {

/// `truth_map` is empty if the truth is not known.
interfaces::ReportPictures reportPictures(const common::World& world, const interfaces::FlightSummary& summary,
                                          const common::Trajectory& truth_map, double hull_diameter_m);

}  // namespace swiftlet::apps
