// config/systems/laser_log.yaml as SLAM and localization take it, for tests and benchmarks of perception alone.
#pragma once

#include <string>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "perception/laser_odometry/laser_front_end.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::test_support {

/// What that profile sets; a key that is not known here fails to read.
struct LaserLogProfile {
  struct Estimator {
    perception::LaserOdometryConfig odometry;
    perception::SlamMethodConfig slam;
    void describe(common::config::Fields& fields) {
      fields.section("odometry", odometry, "");
      fields.section("slam", slam, "");
    }
  };
  struct Autonomy {
    Estimator estimator;
    void describe(common::config::Fields& fields) { fields.section("estimator", estimator, ""); }
  };
  Autonomy autonomy;
  perception::MotionPredictionConfig log_motion;
  void describe(common::config::Fields& fields) {
    fields.section("autonomy", autonomy, "");
    fields.section("log_motion", log_motion, "");
  }
};

inline perception::LaserSlamConfig laserLogSlam() {
  const auto profile =
      common::config::readFile<LaserLogProfile>(common::findData("config/systems/laser_log.yaml").string());
  perception::LaserSlamConfig config;
  config.front_end.odometry = profile.autonomy.estimator.odometry;
  config.front_end.motion = profile.log_motion;
  config.slam = profile.autonomy.estimator.slam;
  return config;
}

inline perception::LaserFrontEndConfig laserLogFrontEnd() { return laserLogSlam().front_end; }

}  // namespace swiftlet::test_support
