// The three matchers on real scans: consecutive scans of two logs of wheeled robots, with the wheel odometry as the
// guess.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "tests/scan_matching/scenes.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// How often a matcher answers, and its distance from the exhaustive one if both answer.
struct Agreement {
  int answered = 0, compared = 0, seen_whole = 0;
  double off2_m2 = 0.0;
  int far_off = 0;
  double rms_m() const { return std::sqrt(off2_m2 / std::max(seen_whole, 1)); }
};

Pose2 odometryOf(const interfaces::LoggedScan& logged) { return logged.T_odom_robot.value_or(Pose2{}); }

ProjectedScan projectedFrom(const interfaces::LoggedScan& logged) {
  return projectLevel(logged.scan, logged.T_robot_laser, odometryOf(logged));
}

/// Each `stride`th scan is matched against the one before.
std::array<Agreement, 3> compareOn(interfaces::LaserLog& log, int stride) {
  const SearchWindow window{0.25, 0.15};
  std::array<Agreement, 3> agreements;
  std::optional<interfaces::LoggedScan> before = log.next();
  for (int i = 1; const auto logged = log.next(); ++i) {
    const interfaces::LoggedScan reference = std::exchange(*before, *logged);
    if (i % stride != 0) continue;
    const ProjectedScan first = projectedFrom(reference), second = projectedFrom(*logged);
    const Pose2 guess = odometryOf(reference).inverse() * odometryOf(*logged);
    CorrelativeMatcher correlative{{}};
    GaussNewtonMatcher gauss_newton;
    PointToLineMatcher point_to_line;
    const std::array<ScanMatcher*, 3> matchers{&correlative, &gauss_newton, &point_to_line};
    MatchResult everywhere;
    for (std::size_t k = 0; k < matchers.size(); ++k) {
      matchers[k]->addReference(first, {});
      const MatchResult match = matchers[k]->match(second, guess, window);
      if (k == 0) everywhere = match;
      Agreement& agreement = agreements[k];
      if (match.failed) continue;
      ++agreement.answered;
      if (everywhere.failed || everywhere.at_window_edge) continue;
      ++agreement.compared;
      if (match.unobservable_motion || everywhere.unobservable_motion) continue;
      ++agreement.seen_whole;
      const double off_m = test::errorOf(match.T_reference_body, everywhere.T_reference_body).head<2>().norm();
      if (off_m > 0.05)
        ++agreement.far_off;
      else
        agreement.off2_m2 += off_m * off_m;
    }
  }
  return agreements;
}

void expectAgreement(const std::string& name, int stride) {
  const auto file = test_support::dataSet("01-laser-slam/" + name);
  if (!file) return;
  const auto log = interfaces::openLaserLog(*file);
  const std::array<Agreement, 3> agreements = compareOn(*log, stride);
  for (std::size_t k = 1; k < agreements.size(); ++k) {
    const Agreement& a = agreements[k];
    SCOPED_TRACE(testing::Message() << "matcher " << k << " of " << agreements[0].answered << ": answered "
                                    << a.answered << ", seen whole " << a.seen_whole << ", far off " << a.far_off
                                    << ", rms " << 1e3 * a.rms_m() << " mm");
    testing::Test::RecordProperty("rms_mm_" + std::to_string(k), std::to_string(1e3 * a.rms_m()));
    EXPECT_GT(a.answered, agreements[0].answered * 95 / 100);
    EXPECT_GT(a.seen_whole, agreements[0].answered / 2);
    EXPECT_LE(a.far_off, a.seen_whole / 50);
    EXPECT_LT(a.rms_m(), 0.012);
  }
}

TEST(RecordedScans, AllMatchersAgreeOnIntel) { expectAgreement("intel/intel.clf.bz2", 20); }
TEST(RecordedScans, AllMatchersAgreeOnFreiburg) { expectAgreement("fr079/fr079.clf.bz2", 10); }

}  // namespace
}  // namespace swiftlet::perception
