#include "interfaces/laser_log/laser_scan_message.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::interfaces {
namespace {

/// Hash of the definition of the type.
constexpr std::string_view kLaserScanMd5 = "90c7ef2dc6895d81024acba2ac42f369";
/// No laser is slower from beam to beam. A larger value was not filled in or is wrong, and counts as zero.
constexpr double kSlowestBeam_s = 1.0;

common::Time timeOf(std::int64_t seconds, std::int64_t nanoseconds) {
  return common::Time::fromNanoseconds(seconds * 1'000'000'000 + nanoseconds);
}

void turnRound(common::LaserScan& scan) {
  scan.angle_min_rad += scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  scan.angle_increment_rad = -scan.angle_increment_rad;
  scan.time_increment = -scan.time_increment;
  std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
}

}  // namespace

bool isLaserScan(const BagConnection& connection) {
  return connection.type == kLaserScanType &&
         (connection.md5sum == kLaserScanMd5 || connection.md5sum == "*" || connection.md5sum.empty());
}

tl::expected<LoggedScan, RecordProblem> parseLaserScan(const BagMessage& message) {
  if (message.bytes > message.data.size())
    return tl::unexpected(
        RecordProblem{0, "", common::Message("bag.scan-too-large", "a scan of {} bytes", message.bytes)});
  MessageCursor cursor(message.data);
  LoggedScan logged;
  common::LaserScan& scan = logged.scan;
  (void)cursor.u32();  // Sequence number.
  const std::uint32_t seconds = cursor.u32(), nanoseconds = cursor.u32();
  (void)cursor.text();  // Frame.
  scan.angle_min_rad = cursor.f32();
  (void)cursor.f32();  // Greatest angle: follows from the number of beams.
  scan.angle_increment_rad = cursor.f32();
  const double time_increment_s = cursor.f32();
  (void)cursor.f32();  // Time between scans.
  scan.range_min_m = cursor.f32();
  scan.range_max_m = cursor.f32();
  const std::uint32_t beams = cursor.u32();
  if (beams > cursor.left() / sizeof(float))
    return tl::unexpected(RecordProblem{
        0, "", common::Message("bag.scan-too-short", "{} beams do not fit into its {} bytes", beams, message.bytes)});
  scan.ranges_m.reserve(beams);
  for (std::uint32_t i = 0; i < beams; ++i) scan.ranges_m.push_back(cursor.f32());
  if (!cursor.whole()) return tl::unexpected(RecordProblem{0, "", common::Message("bag.scan-cut", "is cut")});

  scan.stamps.measured = seconds == 0 && nanoseconds == 0 ? message.recorded : timeOf(seconds, nanoseconds);
  scan.stamps.arrived = scan.stamps.measured;
  if (time_increment_s > 0.0 && time_increment_s <= kSlowestBeam_s)
    scan.time_increment = common::Duration::fromSeconds(time_increment_s);
  if (scan.angle_increment_rad < 0.0 && std::isfinite(scan.angle_increment_rad)) turnRound(scan);
  return logged;
}

}  // namespace swiftlet::interfaces
