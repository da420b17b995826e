// What a filter was told reads back whole, gives another filter the same state, and teaches it its noise parameters.
// NEES and NIS of such flights are near 1 for a filter that is right about its noise, and far above for one that is too
// sure.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perception/fusion/consistency.hpp"
#include "perception/fusion/noise_tuning.hpp"
#include "tests/fusion/synthetic_flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Time;

std::vector<std::string_view> wordsOf(const std::string& line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \n", begin), line.size());
    if (end > begin) words.push_back(std::string_view(line).substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

/// How the laser is mounted otherwise than the filter believes, and by how much its stamps are off.
struct LaserErrors {
  common::Pose2 mount;
  double clock_s = 0.0;
  double reference_every_s = 0.5;  ///< A new reference scan.
};

/// A flight whose scans are late by 20 ms, as a tape.
TapedFlight tapedFlight(std::uint64_t seed, const SensorNoise& noise, double seconds = 20.0,
                        const LaserErrors& laser = {}) {
  SyntheticFlight flight(seed, seconds, noise);
  common::RandomStream random(seed, "tape");
  const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-4, 1e-4, 1.2e-5).asDiagonal();
  TapedFlight taped;
  double reference_s = -1.0, scan_s = 1.0;
  bool started = false;
  for (const common::ImuSample& sample : flight.imuSamples()) {
    taped.inputs.push_back(sample);
    const double now_s = sample.stamps.arrived.seconds();
    if (!started && now_s > 0.8) taped.inputs.push_back(TapedStart{flight.motion.pose(0.8).position_m.z()});
    started = started || now_s > 0.8;
    for (; started && scan_s + 0.02 <= now_s; scan_s += 0.025) {
      const Time to = Time::fromSeconds(scan_s);
      taped.inputs.push_back(
          measuredHeight(to, flight.motion.pose(scan_s).position_m.z() + random.gaussian(0.01), 1e-4));
      if (reference_s >= 0.0) {
        const common::Pose2 moved = planar(flight.motion.pose(reference_s + laser.clock_s)).inverse() *
                                    planar(flight.motion.pose(scan_s + laser.clock_s));
        common::Pose2 relative = laser.mount.inverse() * moved * laser.mount;
        relative.x_m += random.gaussian(0.01);
        relative.y_m += random.gaussian(0.01);
        relative.yaw_rad += random.gaussian(std::sqrt(1.2e-5));
        taped.inputs.push_back(measuredRelativePose(Time::fromSeconds(reference_s), to, relative, covariance, {}));
      }
      if (reference_s < 0.0 || scan_s - reference_s > laser.reference_every_s) {
        taped.inputs.push_back(poseClone(to));
        reference_s = scan_s;
      }
    }
    if (now_s < 6.0) continue;
    const Truth truth = flight.motion.truth(now_s);
    taped.truth.push_back({sample.stamps.arrived, common::yawOf(truth.T_odom_body.rotation), truth.velocity_m_s,
                           truth.T_odom_body.position_m});
  }
  return taped;
}

TEST(FilterTape, EveryInputReadsBackAsItWas) {
  TapedFlight flight = tapedFlight(1, {}, 3.0);
  flight.inputs.push_back(TapedRest{true});
  flight.inputs.push_back(TapedPredicted{true});
  flight.inputs.push_back(knownVertical(Time::fromSeconds(1.5), {1.0, -0.25, 0.02, Eigen::Matrix3d::Identity()}));
  flight.inputs.push_back(measuredRelativePose(Time::fromSeconds(1), Time::fromSeconds(2), {1, 2, 0.3},
                                               Eigen::Matrix3d::Identity(),
                                               common::UnobservableMotion{{0.6, 0.8, -0.3}, 2.5}));
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  covariance(1, 4) = covariance(4, 1) = 0.1;
  flight.inputs.push_back(
      measuredRelativePose3(Time::fromSeconds(1), Time::fromSeconds(2),
                            {common::quaternionFrom({0.1, -0.2, 0.3}), Eigen::Vector3d(0.1, 0.2, -0.3)}, covariance));
  for (const FilterInput& input : flight.inputs) {
    const std::string line = toLine(input);
    const auto read = filterInputOf(wordsOf(line));
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(toLine(*read), line);
  }
  for (const std::string bad : {"", "imu 1 2", "pose a b c", "rest x\n", "clones 12\n", "start 1 2\n"})
    EXPECT_FALSE(filterInputOf(wordsOf(bad))) << bad;
}

TEST(FilterTape, AFilterThatIsToldTheSameHasTheSameState) {
  const TapedFlight flight = tapedFlight(2, {}, 8.0);
  ErrorStateFilter one(withoutDrag()), other(withoutDrag());
  for (const FilterInput& input : flight.inputs) {
    tell(one, input);
    tell(other, *filterInputOf(wordsOf(toLine(input))));
  }
  ASSERT_TRUE(one.initialized());
  EXPECT_EQ(one.state().T_odom_body.position_m, other.state().T_odom_body.position_m);
  EXPECT_EQ(one.state().velocity_odom_m_s, other.state().velocity_odom_m_s);
}

// The parameters start ten times off on the noises that matter; what is learned is judged on other flights.
TEST(NoiseTuning, LearnsBetterVelocitiesOnFlightsThatItDidNotSee) {
  std::vector<TapedFlight> flights;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) flights.push_back(tapedFlight(seed, {}));
  FusionConfig wrong = withoutDrag();
  wrong.accelerometer_noise_m_s2_rthz = 0.5;
  wrong.ahrs_sigma_deg = 0.05;
  wrong.gyroscope_noise_rad_s_rthz = 0.02;
  TuningOptions options;
  options.steps = 12;
  const Tuning tuned = tuneNoise({&flights[0], &flights[1], &flights[2]}, wrong, options);
  EXPECT_LT(tuned.after_m_s, tuned.before_m_s);
  const std::vector<const TapedFlight*> held_out{&flights[3], &flights[4]};
  const double before_m_s = velocityError_m_s(held_out, wrong), after_m_s = velocityError_m_s(held_out, tuned.config);
  std::printf("velocity on held-out flights: %.4f m/s, learned %.4f m/s\n", before_m_s, after_m_s);
  EXPECT_LT(after_m_s, 0.9 * before_m_s);
  EXPECT_EQ(tuneNoise({&flights[0], &flights[1], &flights[2]}, wrong, options).config.ahrs_sigma_deg,
            tuned.config.ahrs_sigma_deg)
      << "it is deterministic";
}

// Samples arrive late: what the filter knows is compared with the truth of then, not of now.
TEST(TapedReplay, GivesTheTruthAtTheTimeOfTheState) {
  TapedFlight flight = tapedFlight(1, {}, 8.0);
  for (FilterInput& input : flight.inputs)
    if (auto* imu = std::get_if<common::ImuSample>(&input)) imu->stamps.arrived += common::Duration::fromSeconds(0.012);
  TapedReplay replay(flight, withoutDrag());
  const Motion motion;
  int compared = 0;
  while (const TrueMotion* now = replay.next()) {
    const TrueMotion truth = replay.truthOfState();
    if (now == &flight.truth.front()) continue;  // Nothing is known of the time before.
    EXPECT_EQ(truth.stamp, replay.filter().newest());
    EXPECT_GE((now->stamp - truth.stamp).seconds(), 0.01);
    if (++compared < 4) continue;
    const Truth then = motion.truth(truth.stamp.seconds());
    EXPECT_LT((truth.position_map_m - then.T_odom_body.position_m).norm(), 1e-4);
    EXPECT_NEAR(common::wrapAngle(truth.yaw_map_rad - common::yawOf(then.T_odom_body.rotation)), 0.0, 1e-4);
  }
  EXPECT_GT(compared, 300);
}

TEST(ChiSquaredBounds, AgreeWithTables) {
  EXPECT_NEAR(chiSquaredBounds95(100).lower * 100, 74.22, 0.1);
  EXPECT_NEAR(chiSquaredBounds95(100).upper * 100, 129.56, 0.1);
  EXPECT_NEAR(chiSquaredBounds95(10).upper * 10, 20.48, 0.1);
}

std::vector<TapedFlight> tapedFlights() {
  std::vector<TapedFlight> flights;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) flights.push_back(tapedFlight(seed, {}, 12.0));
  return flights;
}

TEST(FlightConsistency, IsOneForAFilterThatIsRightAboutItsNoise) {
  const Consistency consistency = consistencyOf(tapedFlights(), withoutDrag());
  ASSERT_EQ(consistency.flights, 20u);
  ASSERT_EQ(consistency.errors.size(), 5u);
  for (const ConsistencyFigure& figure : consistency.errors) {
    std::printf("  %s: NEES %.2f, %.0f %% within\n", figure.name.c_str(), figure.mean, 100 * figure.inside_share);
    EXPECT_GT(figure.mean, 0.4) << figure.name;
    EXPECT_LT(figure.mean, 1.6) << figure.name;
    EXPECT_TRUE(figure.well_sized()) << figure.name << " " << figure.sigma_ratio;
  }
  ASSERT_EQ(consistency.innovations.size(), 2u);
  for (const ConsistencyFigure& figure : consistency.innovations) {
    EXPECT_GT(figure.mean, 0.5) << figure.name;
    EXPECT_LT(figure.mean, 1.6) << figure.name;
    EXPECT_GT(figure.upper, 1.0) << figure.name;
  }
  EXPECT_EQ(consistency.innovations[1].degrees, 40) << "heights in a second";
}

/// All scans are matched to the first one, by lasers whose mounts and clocks are as far off as the filter believes.
std::vector<TapedFlight> flightsWithLasersAskew() {
  std::vector<TapedFlight> flights;
  const FusionConfig config;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    common::RandomStream random(seed, "laser");
    LaserErrors laser;
    laser.mount.yaw_rad = random.gaussian(config.laser_yaw_sigma_deg * common::kRadPerDeg);
    laser.mount.x_m = random.gaussian(config.laser_position_sigma_m);
    laser.mount.y_m = random.gaussian(config.laser_position_sigma_m);
    laser.clock_s = random.gaussian(config.laser_clock_sigma_s);
    laser.reference_every_s = 1e9;
    flights.push_back(tapedFlight(seed, {}, 12.0, laser));
  }
  return flights;
}

TEST(FlightConsistency, HoldsForLasersAskewWhereTheirMountIsConsidered) {
  const std::vector<TapedFlight> flights = flightsWithLasersAskew();
  const Consistency considered = consistencyOf(flights, withoutDrag());
  FusionConfig sure = withoutDrag();
  sure.laser_yaw_sigma_deg = sure.laser_position_sigma_m = sure.laser_clock_sigma_s = 0.0;
  const Consistency exact = consistencyOf(flights, sure);
  ASSERT_EQ(considered.flights, 20u);
  ASSERT_EQ(exact.flights, 20u);
  for (const std::size_t i : {2u, 3u}) {
    const ConsistencyFigure& figure = considered.errors[i];
    std::printf("  %s: NEES %.2f, %.2f where the mount counts as exact\n", figure.name.c_str(), figure.mean,
                exact.errors[i].mean);
    EXPECT_GT(figure.mean, 0.4) << figure.name;
    EXPECT_LT(figure.mean, 1.6) << figure.name;
    EXPECT_TRUE(figure.well_sized()) << figure.name << " " << figure.sigma_ratio;
  }
  EXPECT_GT(exact.errors[2].mean, 4.0);
  EXPECT_FALSE(exact.errors[2].consistent());
  EXPECT_FALSE(exact.errors[2].well_sized());
}

TEST(FlightConsistency, IsMuchMoreThanOneForAFilterThatIsNot) {
  // Scans and heights are told to be five times as good as they are.
  std::vector<TapedFlight> flights = tapedFlights();
  for (TapedFlight& flight : flights)
    for (FilterInput& input : flight.inputs) {
      if (auto* measurement = std::get_if<Measurement>(&input)) measurement->covariance *= 0.04;
    }
  const Consistency consistency = consistencyOf(flights, withoutDrag());
  ASSERT_GT(consistency.flights, 0u);
  EXPECT_GT(consistency.errors[0].mean, 3.0);
  EXPECT_LT(consistency.errors[0].inside_share, 0.5);
  EXPECT_FALSE(consistency.errors[0].consistent());
  EXPECT_FALSE(consistency.errors[0].well_sized());
  EXPECT_GT(consistency.innovations[0].mean, 3.0);
  EXPECT_FALSE(consistency.innovations[0].consistent());
}

}  // namespace
}  // namespace swiftlet::perception
