#include <cmath>
#include <ctime>
#include <fstream>

#include <gtest/gtest.h>

#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/laser_odometry.hpp"
#include "perception/slam2d/slam2d.hpp"
#include "tests/slam2d/recorded_log.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

double cpuTime_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

void writePicture(const common::OccupancyGrid& grid, const std::string& file) {
  const common::CellRect rect = knownExtent(grid);
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << rect.width() << ' ' << rect.height() << "\n255\n";
  for (int y = rect.end.y - 1; y >= rect.begin.y; --y)
    for (int x = rect.begin.x; x < rect.end.x; ++x) {
      const auto cell = grid.at({x, y});
      out.put(static_cast<char>(common::occupancy::isUnknown(cell) ? 200 : 127 - cell * 127 / 100));
    }
}

enum class Prediction { kOdometry, kConstantVelocity };

test::RelationError replay(const std::string& name, Prediction prediction) {
  const auto folder = test::datasets() / "01-laser-slam" / name;
  auto log = test::readScans(folder / (name + ".clf.bz2"));
  if (const char* v = getenv("MAXN")) log.resize(std::min<std::size_t>(log.size(), atoi(v)));
  const auto relations = test::readRelations(folder / (name + ".relations.gz"));
  if (log.empty()) return {};
  common::LaserConfig laser;
  laser.beams = 0;  // The scans' own angles.
  Slam2dConfig config;
  LaserOdometryConfig odometry_config;
  if (const char* v = getenv("LSIG")) config.local_sigma_m = atof(v);
  if (const char* v = getenv("ESIG")) config.edge_sigma_m = atof(v);
  if (const char* v = getenv("EDEG")) config.edge_sigma_deg = atof(v);
  if (const char* v = getenv("LOOPS")) config.loops.max_candidates = atoi(v);
  if (const char* v = getenv("LQ")) config.loops.min_quality = atof(v);
  if (const char* v = getenv("LA")) config.loops.max_ambiguity = atof(v);
  if (const char* v = getenv("LCHI")) config.loops.max_edge_sigmas = atof(v);
  if (const char* v = getenv("QS")) config.loops.query_scans = atoi(v);
  if (const char* v = getenv("OV")) odometry_config.min_overlap = atof(v);
  if (const char* v = getenv("SIG")) odometry_config.matcher.sigma_m = config.matcher.sigma_m = atof(v);
  if (const char* v = getenv("RES")) odometry_config.matcher.resolution_m = config.matcher.resolution_m = atof(v);
  if (const char* v = getenv("GW")) odometry_config.matcher.guess_weight = config.matcher.guess_weight = atof(v);
  if (const char* v = getenv("GD")) odometry_config.matcher.guess_distance_m = config.matcher.guess_distance_m = atof(v);
  if (const char* v = getenv("MQ")) odometry_config.matcher.min_quality = config.matcher.min_quality = atof(v);
  LaserOdometry odometry(odometry_config);
  Slam2d slam(config);

  Pose2 T_odom_body, T_odom_reference, last_step, last_wheel, wheel_at_last;
  std::vector<std::pair<long long, std::pair<common::Time, Pose2>>> track;  // stamp, T_odom_body by the laser
  double odometry_s = 0, slam_s = 0, task_s = 0, task_max = 0;
  bool first = true;
  common::Time last_time; double last_dt = 0.1;
  for (const auto& r : log) {
    const double dt = first ? 0.1 : (r.scan.stamps.measured - last_time).seconds();
    Pose2 step;
    if (!first) {
      if (prediction == Prediction::kOdometry) step = last_wheel.inverse() * r.T_odom_laser;
      else { const double f = std::min(2.0, dt / last_dt); step = {last_step.x_m * f, last_step.y_m * f, last_step.yaw_rad * f}; }
    }
    const Pose2 predicted = first ? Pose2{} : T_odom_body * step;
    const common::Pose3 lifted = common::lifted(predicted, 1.0);
    ProjectedScan scan = project(r.scan, laser, [&](common::Time) { return lifted; }, {});
    double t0 = cpuTime_s();
    const auto relative = odometry.add(scan);
    odometry_s += cpuTime_s() - t0;
    Pose2 now = predicted;
    Eigen::Matrix3d covariance = Eigen::Vector3d(1e-3, 1e-3, 1e-3).asDiagonal();
    if (relative) {
      if (relative->from != relative->to) { now = T_odom_reference * relative->T_from_to; covariance = Eigen::Vector3d(4e-6, 4e-6, 1e-6).asDiagonal(); }
      if (relative->reference_changed) T_odom_reference = now;
    }
    if (getenv("DUMP")) { const Pose2 w = last_wheel.inverse() * r.T_odom_laser, l = T_odom_body.inverse() * now; const Pose2 e = w.inverse() * l; static std::size_t idx = 0; ++idx;
      if (e.position_m().norm() > 0.08 || std::abs(e.yaw_rad) > 0.06) printf("scan %zu diff %.3f %.3f %.4f wheel %.3f %.3f %.4f q %.2f pts %zu unobs %d dt %.3f ref %d\n", idx, e.x_m, e.y_m, e.yaw_rad, w.x_m, w.y_m, w.yaw_rad, relative ? relative->quality : -1, scan.points_level_m.size(), relative && relative->unobservable_direction, dt, relative && relative->reference_changed); }
    last_step = T_odom_body.inverse() * now;
    T_odom_body = now;
    last_wheel = r.T_odom_laser;
    last_dt = std::max(dt, 0.01);
    last_time = r.scan.stamps.measured;
    first = false;
    t0 = cpuTime_s();
    slam.addScan(scan, T_odom_body, covariance);
    slam_s += cpuTime_s() - t0;
    t0 = cpuTime_s();
    if (const auto task = slam.takeTask()) {
      const auto result = run(*task);
      if (getenv("VERBOSE")) for (auto& a : result.accepted) printf("loop %d-%d q %.2f shift %.3f\n", a.from, a.to, a.quality, a.shift_m);
      slam.apply(result);
      task_max = std::max(task_max, cpuTime_s() - t0);
    }
    task_s += cpuTime_s() - t0;
    track.push_back({test::stampKey(r.ipc_stamp), {scan.stamp, T_odom_body}});
  }
  // Each scan stands where the key scan before it ended up, moved on by the odometry.
  const auto keys = slam.keyPoses();
  std::map<long long, Pose2> odom_poses, map_poses;
  std::size_t k = 0;
  Pose2 T_odom_key;
  std::size_t at = 0;
  for (const auto& [stamp, entry] : track) {
    while (k + 1 < keys.size() && keys[k + 1].stamp <= entry.first) ++k;
    if (entry.first == keys[k].stamp || at != k) { T_odom_key = entry.second; at = k; }
    odom_poses[stamp] = entry.second;
    map_poses[stamp] = keys[k].T_map_body * (T_odom_key.inverse() * entry.second);
  }
  const auto o = test::scoreRelations(relations, odom_poses), m = test::scoreRelations(relations, map_poses);
  const auto oc = odometry.counts(); const auto sc = slam.counts();
  fflush(stdout); printf("%s %s: laser odometry %.4f m max %.2f %.3f deg | slam %.4f +- %.4f m max %.2f, %.3f deg (%d) | odo %.3f ms/scan fail %lu refs %lu restarts %lu | slam %.3f ms/scan, tasks %.2f s max %.3f | keys %lu local %lu failed %lu loops %lu of %lu\n",
    name.c_str(), prediction == Prediction::kOdometry ? "wheels" : "const.vel.", o.translation_mean_m, o.translation_max_m, o.rotation_mean_deg, m.translation_mean_m, m.translation_std_m, m.translation_max_m, m.rotation_mean_deg, m.compared,
    1e3 * odometry_s / log.size(), oc.failures, oc.references, oc.restarts, 1e3 * slam_s / log.size(), task_s, task_max, sc.key_scans, sc.local_matches, sc.local_failures, sc.loops_closed, sc.loop_candidates);
  writePicture(slam.snapshot(), std::string(SWIFTLET_BINARY_DIR) + "/" + name + (prediction == Prediction::kOdometry ? "" : "_cv") + ".pgm");
  return m;
}

TEST(RecordedLog, Intel) { replay("intel", Prediction::kOdometry); }
TEST(RecordedLog, Fr079) { replay("fr079", Prediction::kOdometry); }
TEST(RecordedLog, IntelCv) { replay("intel", Prediction::kConstantVelocity); }
TEST(RecordedLog, Fr079Cv) { replay("fr079", Prediction::kConstantVelocity); }

}  // namespace
}  // namespace swiftlet::perception
