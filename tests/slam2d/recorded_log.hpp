// Recorded logs in CARMEN's old text format, as far as the tests need them: FLASER lines, and the relations by which a
// trajectory is scored (Kuemmerle 2009). The data lie outside the repository; SWIFTLET_DATASETS names their folder.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::test {

inline std::filesystem::path datasets() {
  if (const char* folder = std::getenv("SWIFTLET_DATASETS")) return folder;
  return std::filesystem::path(SWIFTLET_SOURCE_DIR) / ".." / "shared" / "datasets";
}

/// The lines of a .gz, .bz2 or plain file; empty when it cannot be read.
inline std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  if (!std::filesystem::exists(file)) return lines;
  const std::string tool = file.extension() == ".bz2"  ? "bzip2 -dc '"
                           : file.extension() == ".gz" ? "gzip -dc '"
                                                       : "cat '";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((tool + file.string() + "'").c_str(), "r"), pclose);
  if (!pipe) return lines;
  std::string line;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    if (c != '\n') {
      line.push_back(static_cast<char>(c));
      continue;
    }
    lines.push_back(std::move(line));
    line.clear();
  }
  return lines;
}

struct RecordedScan {
  std::string ipc_stamp;  ///< As written; the relations name scans by it.
  common::LaserScan scan;
  common::Pose2 T_odom_laser;
};

/// In the order of the file. Stamps that do not grow are moved a millisecond behind the one before.
inline std::vector<RecordedScan> readScans(const std::filesystem::path& file) {
  std::vector<RecordedScan> scans;
  for (const std::string& line : linesOf(file)) {
    std::istringstream in(line);
    std::string word;
    if (!(in >> word) || word != "FLASER") continue;
    RecordedScan r;
    int beams = 0;
    in >> beams;
    for (int i = 0; i < beams; ++i) {
      float range = 0.0F;
      in >> range;
      r.scan.ranges_m.push_back(range);
    }
    double skip = 0.0, stamp = 0.0;
    in >> r.T_odom_laser.x_m >> r.T_odom_laser.y_m >> r.T_odom_laser.yaw_rad >> skip >> skip >> skip >> r.ipc_stamp;
    if (!in) continue;
    stamp = std::stod(r.ipc_stamp);
    common::Time time = common::Time::fromSeconds(stamp);
    if (!scans.empty() && time <= scans.back().scan.stamps.measured)
      time = scans.back().scan.stamps.measured + common::Duration::fromMilliseconds(1);
    r.scan.stamps = {time, time};
    r.scan.angle_min_rad = -0.5 * std::numbers::pi;
    r.scan.angle_increment_rad = beams > 180 ? std::numbers::pi / 360.0 : std::numbers::pi / 180.0;
    r.scan.range_min_m = 0.1;
    r.scan.range_max_m = 50.0;
    scans.push_back(std::move(r));
  }
  return scans;
}

struct Relation {
  std::string from, to;
  common::Pose2 T_from_to;
};

inline std::vector<Relation> readRelations(const std::filesystem::path& file) {
  std::vector<Relation> relations;
  for (const std::string& line : linesOf(file)) {
    std::istringstream in(line);
    Relation r;
    double z = 0.0, roll = 0.0, pitch = 0.0;
    if (in >> r.from >> r.to >> r.T_from_to.x_m >> r.T_from_to.y_m >> z >> roll >> pitch >> r.T_from_to.yaw_rad)
      relations.push_back(r);
  }
  return relations;
}

/// The name by which a stamp of log and relations agree: microseconds.
inline long long stampKey(const std::string& stamp) { return std::llround(std::stod(stamp) * 1e6); }

struct RelationError {
  double translation_mean_m = 0.0, translation_std_m = 0.0, rotation_mean_deg = 0.0;
  double translation_max_m = 0.0;
  int compared = 0;
};

inline RelationError scoreRelations(const std::vector<Relation>& relations,
                                    const std::map<long long, common::Pose2>& poses) {
  RelationError error;
  double sum = 0.0, sum2 = 0.0, yaw = 0.0;
  for (const Relation& r : relations) {
    const auto a = poses.find(stampKey(r.from)), b = poses.find(stampKey(r.to));
    if (a == poses.end() || b == poses.end()) continue;
    const common::Pose2 e = r.T_from_to.inverse() * (a->second.inverse() * b->second);
    const double t = e.position_m().norm();
    sum += t;
    sum2 += t * t;
    yaw += std::abs(e.yaw_rad);
    error.translation_max_m = std::max(error.translation_max_m, t);
    ++error.compared;
  }
  if (error.compared == 0) return error;
  error.translation_mean_m = sum / error.compared;
  error.translation_std_m =
      std::sqrt(std::max(0.0, sum2 / error.compared - error.translation_mean_m * error.translation_mean_m));
  error.rotation_mean_deg = yaw / error.compared * 180.0 / std::numbers::pi;
  return error;
}

}  // namespace swiftlet::test
