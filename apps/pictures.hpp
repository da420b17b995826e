// What a run's report shows: the map and the plots, drawn from what is known so far.
#pragma once

#include "common/trajectory.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::apps {

/// `truth_map` may be empty where there is no truth.
interfaces::ReportPictures reportPictures(const common::World& world, const interfaces::FlightSummary& summary,
                                          const common::Trajectory& truth_map, double hull_diameter_m);

}  // namespace swiftlet::apps
