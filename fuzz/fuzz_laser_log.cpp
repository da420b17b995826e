// links: interfaces common
// Any bytes, also compressed ones, as a laser log: refused as InputError, or scans that a laser can have made, with
// every record counted; a second reading gives the same.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"

namespace {

using namespace swiftlet;

void check(const interfaces::LoggedScan& logged) {
  const common::LaserScan& scan = logged.scan;
  const double beams = static_cast<double>(scan.ranges_m.size());
  if (!isFinite(logged.T_robot_laser) || (logged.T_odom_robot && !isFinite(*logged.T_odom_robot))) std::abort();
  if (!std::isfinite(scan.angle_min_rad) || !(scan.range_max_m > scan.range_min_m)) std::abort();
  if (beams > 1 && !(scan.angle_increment_rad > 0 && scan.angle_increment_rad * (beams - 1) < 2.1 * std::numbers::pi))
    std::abort();
  for (const float range_m : scan.ranges_m)
    if (range_m < 0.0F || (std::isfinite(range_m) && range_m >= static_cast<float>(scan.range_max_m))) std::abort();
}

struct Reading {
  std::uint64_t scans = 0, skipped = 0, invalid = 0;
  std::int64_t stamps_ns = 0;
  bool refused = false;
  bool operator==(const Reading&) const = default;
};

Reading read(const std::string& file, const interfaces::LaserLogOptions& options) {
  Reading reading;
  try {
    const auto log = interfaces::openLaserLog(file, options);
    try {
      while (const auto logged = log->next()) {
        check(*logged);
        ++reading.scans;
        reading.stamps_ns ^= logged->scan.stamps.measured.nanoseconds();
      }
    } catch (const common::InputError& error) {
      reading.refused = true;
      if (error.problems().empty()) std::abort();
    }
    if (log->counts().scans != reading.scans || log->progress() < 0.0 || log->progress() > 1.0) std::abort();
    if (log->format().empty()) std::abort();
    (void)log->notes();
    reading.skipped = log->counts().skipped_records;
    reading.invalid = log->counts().invalid_ranges;
    if ((reading.skipped > 0) == log->counts().first_problems.empty()) std::abort();
  } catch (const common::InputError& error) {
    reading.refused = true;
    if (error.problems().empty()) std::abort();
  }
  return reading;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::put("log", {reinterpret_cast<const char*>(data), size});
  const Reading first = read(file, {});
  if (!(read(file, {}) == first)) std::abort();
  interfaces::LaserLogOptions options;
  options.sensor = common::LaserConfig();
  (void)read(file, options);
  return 0;
}
