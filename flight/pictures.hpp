// The map and the plots of a run's report, drawn from the data so far.
#pragma once

#include <string>

#include "common/trajectory.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::common {
struct World;
}
namespace swiftlet::rendering {
struct Picture3d;
}

namespace swiftlet::flight {

/// `truth_map` is empty if the truth is not known.
interfaces::ReportPictures reportPictures(const common::World& world, const interfaces::FlightSummary& summary,
                                          const common::Trajectory& truth_map, double hull_diameter_m);

/// The whole of a 3D map for a report: a JPEG in base64. A cloud of a million points is drawn in some 50 ms.
std::string map3dPicture(const rendering::Picture3d& picture);

}  // namespace swiftlet::flight
