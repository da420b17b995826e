// Two classic logs of wheeled robots, with wheel odometry as the prediction and one set of parameters for both, scored
// by the relations of Kuemmerle 2009. The published figures of Cartographer are 0.0229 m (intel) and 0.0452 m (fr079).
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/laser_odometry.hpp"
#include "perception/slam2d/slam2d.hpp"
#include "tests/slam2d/recorded_log.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

void writePicture(const common::OccupancyGrid& grid, const std::string& file) {
  const common::CellRect rect = knownExtent(grid);
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << rect.width() << ' ' << rect.height() << "\n255\n";
  for (int y = rect.end.y - 1; y >= rect.begin.y; --y) {
    for (int x = rect.begin.x; x < rect.end.x; ++x) {
      const auto cell = grid.at({x, y});
      out.put(static_cast<char>(common::occupancy::isUnknown(cell) ? 200 : 127 - cell * 127 / 100));
    }
  }
}

/// The laser odometry in place of a filter: what the wheels say between two scans, corrected by each match.
class Replay {
 public:
  void add(const test::RecordedScan& recorded) {
    const Pose2 predicted = track_.empty() ? Pose2{} : T_odom_body_ * (T_wheels_.inverse() * recorded.T_odom_laser);
    common::LaserConfig laser;
    laser.mirror_beams = 0;
    const ProjectedScan scan =
        project(recorded.scan, laser, [&](common::Time) { return common::lifted(predicted, 1.0); }, {});
    const auto relative = odometry_.add(scan, T_odom_matched_);
    T_odom_body_ = predicted;
    Eigen::Matrix3d covariance = Eigen::Vector3d(1e-3, 1e-3, 1e-3).asDiagonal();
    if (relative) {
      if (relative->from != relative->to) T_odom_body_ = T_odom_reference_ * relative->T_from_to;
      if (relative->reference_changed) T_odom_reference_ = T_odom_body_;
      T_odom_matched_ = T_odom_body_;
      covariance = Eigen::Vector3d(4e-6, 4e-6, 1e-6).asDiagonal();
    }
    T_wheels_ = recorded.T_odom_laser;
    slam_.addScan(scan, T_odom_body_, covariance);
    if (const auto task = slam_.takeTask()) slam_.apply(run(*task));
    track_.push_back({test::stampKey(recorded.ipc_stamp), scan.stamp, T_odom_body_});
  }

  /// Each scan stands where the key scan before it ended up, moved on by the odometry.
  std::map<long long, Pose2> trajectory() const {
    const auto keys = slam_.keyPoses();
    std::map<long long, Pose2> poses;
    std::size_t key = 0;
    Pose2 T_odom_key = track_.front().T_odom_body;
    for (const Entry& entry : track_) {
      while (key + 1 < keys.size() && keys[key + 1].stamp <= entry.stamp) {
        ++key;
        T_odom_key = entry.T_odom_body;
      }
      poses[entry.name] = keys[key].T_map_body * (T_odom_key.inverse() * entry.T_odom_body);
    }
    return poses;
  }

  Slam2d& slam() { return slam_; }

 private:
  struct Entry {
    long long name;
    common::Time stamp;
    Pose2 T_odom_body;
  };
  LaserOdometry odometry_{{}};
  Slam2d slam_{{}};
  Pose2 T_odom_body_, T_odom_reference_, T_wheels_;
  std::optional<Pose2> T_odom_matched_;
  std::vector<Entry> track_;
};

void expectRelations(const std::string& name, double translation_m, double rotation_deg) {
  const auto folder = test::datasets() / "01-laser-slam" / name;
  const auto log = test::readScans(folder / (name + ".clf.bz2"));
  const auto relations = test::readRelations(folder / (name + ".relations.gz"));
  if (log.empty() || relations.empty()) GTEST_SKIP() << "NOT TESTED: no log in " << folder << "; set SWIFTLET_DATASETS";
  Replay replay;
  for (const test::RecordedScan& recorded : log) replay.add(recorded);
  const test::RelationError error = test::scoreRelations(relations, replay.trajectory());
  const SlamCounts& counts = replay.slam().counts();
  printf("  %s: %.4f +- %.4f m, at most %.2f m; %.3f deg (%d relations); %d key scans, %d loops of %d candidates\n",
         name.c_str(), error.translation_mean_m, error.translation_std_m, error.translation_max_m,
         error.rotation_mean_deg, error.compared, static_cast<int>(counts.key_scans),
         static_cast<int>(counts.loops_closed), static_cast<int>(counts.loop_candidates));
  writePicture(replay.slam().snapshot(), std::string(SWIFTLET_BINARY_DIR) + "/" + name + ".pgm");
  EXPECT_EQ(error.compared, static_cast<int>(relations.size()));
  EXPECT_LT(error.translation_mean_m, translation_m);
  EXPECT_LT(error.rotation_mean_deg, rotation_deg);
}

TEST(RecordedLog, Intel) { expectRelations("intel", 0.03, 0.4); }
TEST(RecordedLog, Freiburg079) { expectRelations("fr079", 0.06, 0.6); }

}  // namespace
}  // namespace swiftlet::perception
