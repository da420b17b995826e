// By how much the horizon of the AHRS is wrong.
#include "autonomy/inertial/horizon_offset.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

using common::quaternionFrom;
using common::Time;

TEST(HorizonOffset, FollowsWhatTheAhrsSaysBesideTheEstimateInTheAxesOfTheBody) {
  HorizonOffset offset;
  EXPECT_TRUE(offset.offset_rad().isZero());
  for (double t_s = 0.0; t_s < 3.0; t_s += 0.01)  // The AHRS has a heading of its own.
    offset.observe(Time::fromSeconds(t_s), quaternionFrom({0.12, -0.05, 2.0}), quaternionFrom({0.10, -0.04, 0.3}));
  EXPECT_NEAR(offset.offset_rad().x(), 0.02, 1e-4);
  EXPECT_NEAR(offset.offset_rad().y(), -0.01, 1e-4);
}

TEST(HorizonOffset, NeitherAnAttitudeThatIsNoneNorAFaultOfManyDegreesTiltsTheVehicle) {
  HorizonOffset offset;
  const Eigen::Quaterniond level = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond none = level;
  none.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  offset.observe(Time::fromSeconds(0.0), level, level);
  offset.observe(Time::fromSeconds(0.5), none, level);
  EXPECT_TRUE(offset.offset_rad().isZero());
  for (double t_s = 1.0; t_s < 5.0; t_s += 0.01)
    offset.observe(Time::fromSeconds(t_s), quaternionFrom({0.5, -0.5, 0.0}), level);
  EXPECT_NEAR(offset.offset_rad().x(), 3.0 * common::kRadPerDeg, 1e-9);
  EXPECT_NEAR(offset.offset_rad().y(), -3.0 * common::kRadPerDeg, 1e-9);
}

}  // namespace
}  // namespace swiftlet::autonomy
