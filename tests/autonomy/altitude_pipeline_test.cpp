// What was seen of the ground, across a correction of the map.
#include "autonomy/estimation/altitude_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Pose2;
using common::Time;

/// A vehicle that hovers 1 m over a table of 0.4 m at (3, 0), as seen from the second key scan.
class OverATable : public testing::Test {
 protected:
  OverATable() : pipeline_({}, 0.25) {
    pipeline_.initialize(Time(), 0.15);
    keys_.keys = {{{}, Pose2{}}, {{}, Pose2{2.0, 0.0, 0.0}}};
  }
  void follow() {
    ++keys_.version;
    pipeline_.follow(keys_, 1);
  }
  void hover() {
    for (int i = 1; i <= 20; ++i) {
      perception::ProjectedScan scan;
      scan.stamp = Time::fromSeconds(0.1 * i);
      perception::MirrorPoint beam;
      beam.z_level_m = -1.0F;
      scan.mirror.assign(6, beam);
      const perception::VerticalMotion vertical{{1.4, 0.0, 0.0, 1e-4 * Eigen::Matrix3d::Identity()}, std::nullopt};
      pipeline_.add(scan, Pose2{}, Pose2{3.05, 0.05, 0.0}, vertical, false);
    }
  }
  bool tableAt(double x_m, double y_m) const {
    const common::LevelMap map = pipeline_.seenSurfaces();
    const common::CellIndex cell{static_cast<int>(std::floor(x_m / map.resolution_m)),
                                 static_cast<int>(std::floor(y_m / map.resolution_m))};
    return std::any_of(map.levels.begin(), map.levels.end(), [&](const common::Level& level) {
      return std::abs(level.height_m - 0.4) < 0.03 &&
             std::find(level.cells.begin(), level.cells.end(), cell) != level.cells.end();
    });
  }

  AltitudePipeline pipeline_;
  common::KeyPoses keys_;
};

TEST_F(OverATable, TheTableMovesWithTheKeyScanFromWhichItWasSeen) {
  follow();
  hover();
  ASSERT_TRUE(tableAt(3.05, 0.05));
  keys_.keys[1].T_map_key = {2.0, 1.0, 0.0};
  follow();
  EXPECT_TRUE(tableAt(3.05, 1.05));
  EXPECT_FALSE(tableAt(3.05, 0.05));
}

}  // namespace
}  // namespace swiftlet::autonomy
