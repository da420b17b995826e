// What a flight takes of the computer: processor time of jobs, resident memory.
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "flight/memory_watch.hpp"
#include "flight/timed_jobs.hpp"

namespace swiftlet::flight {
namespace {

using common::Duration;
using common::Time;

TEST(JobMeter, GivesTheMediansOfTheFirstAndTheLastTenth) {
  JobMeter meter;
  for (int i = 0; i < 50; ++i) meter.add("frame", i == 2 ? 900.0 : i < 45 ? 10.0 + i : 30.0 + i);
  EXPECT_FALSE(meter.ends("fusion"));
  const auto ends = meter.ends("frame");
  ASSERT_TRUE(ends);
  EXPECT_EQ(ends->first_ms, 13.0) << "of 10, 11, 900, 13 and 14";
  EXPECT_EQ(ends->last_ms, 77.0) << "of 75 to 79";
  for (int i = 0; i < 9; ++i) meter.add("few", 1.0);
  EXPECT_FALSE(meter.ends("few")) << "less than one in each tenth";
  meter.add("few", 1.0);
  EXPECT_TRUE(meter.ends("few"));
}

/// Sleeping takes none; and a delivery is as without the meter.
TEST(TimedJobs, CountProcessorTimeAndChangeNoDelivery) {
  const auto meter = std::make_shared<JobMeter>();
  const auto jobs = timed(common::makeLockstepJobs(1), meter);
  std::vector<double> delivered_s;
  const auto run = [&](const std::string& kind, double now_s, const std::function<void()>& work) {
    ASSERT_TRUE(jobs->idle(kind));
    jobs->submit(kind, Time::fromSeconds(now_s), Duration::fromSeconds(0.5), [&, work]() -> common::JobRunner::Deliver {
      work();
      return [&](Time at) { delivered_s.push_back(at.seconds()); };
    });
    EXPECT_FALSE(jobs->nextDue(Time::fromSeconds(now_s + 0.4)));
    jobs->deliverDue(Time::fromSeconds(now_s + 0.9));
  };
  for (int i = 0; i < 10; ++i) {
    run("sleeps", i, [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); });
    run("works", i, [] {
      volatile double sum = 0.0;
      for (int k = 0; k < 20'000'000; ++k) sum = sum + k;
    });
  }
  ASSERT_EQ(delivered_s.size(), 20u);
  EXPECT_NEAR(delivered_s[0], 0.5, 1e-9) << "when it was declared for";
  ASSERT_TRUE(meter->ends("sleeps") && meter->ends("works"));
  EXPECT_LT(meter->ends("sleeps")->last_ms, 5.0);
  EXPECT_GT(meter->ends("works")->last_ms, 5.0);
  EXPECT_TRUE(jobs->times().empty()) << "the loop must not say what depends on the computer";
}

/// 300 MB that are written and given back again are the most that was needed; they count only for the flight that
/// needed them.
TEST(MemoryWatch, KnowsTheMostThatWasResident) {
  MemoryWatch first;
  const double begin_MB = first.peak_MB();
  EXPECT_GT(begin_MB, 5.0);
  { const std::vector<char> large(300'000'000, 'x'); }
  EXPECT_NEAR(first.peak_MB(), begin_MB + 300.0, 40.0);
  MemoryWatch second;
  EXPECT_LT(second.peak_MB(), begin_MB + 100.0);
  const std::vector<char> held(150'000'000, 'x');
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  second.look();
  EXPECT_NEAR(second.peak_MB(), begin_MB + 150.0, 40.0);
}

}  // namespace
}  // namespace swiftlet::flight
