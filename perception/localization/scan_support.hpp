// How much of what a scan saw the map explains from a pose, and what that says of the pose.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "perception/localization/map_field.hpp"

namespace swiftlet::perception {

struct ScanSupportConfig {
  int beams = 90;
  double tolerance_m = 0.20;
  double tolerance_rad = 0.015;

  void describe(common::config::Fields& fields);
};

/// Beams that end where the map knows nothing say nothing and are left out.
struct ScanSupport {
  int beams = 0;           ///< Looked at.
  int evidence = 0;        ///< Of these, that say something.
  double explained = 0.0;  ///< Share of those that end on a wall of the map, with none before it.
};

ScanSupport supportOf(const MapField& map, std::span<const Eigen::Vector2f> points_body_m,
                      const common::Pose2& T_grid_body, const ScanSupportConfig& config);

struct LostTestConfig {
  double at_none = 9.4;
  double by_explained = -17.6;
  double most = 3.0;
  double scans_per_s = 2.0;
  double distrust_explained = 0.75;
  double threshold = 5.0;
  int least_evidence = 15;

  void describe(common::config::Fields& fields);
};

/// Page's cumulative sum test (1954): the sum of the log-odds of the scans, never below zero, so that it is soon
/// noticed when the pose becomes wrong, however long it was right. Not thread-safe.
class LostTest {
 public:
  explicit LostTest(const LostTestConfig& config) : config_(config) {}

  void reset();
  void add(const ScanSupport& support, double elapsed_s);
  /// That the pose is wrong, by this scan alone; 0 when it says too little.
  double logOdds(const ScanSupport& support) const;

  bool lost() const { return sum_ >= config_.threshold; }
  /// Something speaks against the pose.
  bool doubtful() const { return sum_ > 0.0 || explained_ < config_.distrust_explained; }
  /// Mean share explained, lately.
  double explained() const { return explained_; }

 private:
  LostTestConfig config_;
  double sum_ = 0.0, explained_ = 1.0;
};

}  // namespace swiftlet::perception
