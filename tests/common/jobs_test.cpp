// Jobs on both clocks: when a result is due, and that a recording can deliver it again.
#include "common/jobs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>

namespace swiftlet::common {
namespace {

/// Which job was delivered, and at how many milliseconds.
using Delivered = std::vector<std::pair<int, std::int64_t>>;

std::int64_t millisecondsOf(Time time) { return time.nanoseconds() / 1'000'000; }

/// Work that takes no time and writes down when it was delivered.
JobRunner::Work note(Delivered& delivered, int id) {
  return [&delivered, id]() -> JobRunner::Deliver {
    return [&delivered, id](Time t) { delivered.emplace_back(id, millisecondsOf(t)); };
  };
}

TEST(LockstepJobs, AreDeliveredAtTheDeclaredTimeWithAnyNumberOfThreads) {
  for (const int threads : {0, 2}) {
    auto jobs = makeLockstepJobs(threads);
    Delivered delivered;
    jobs->submit("slow", Time{}, Duration::fromSeconds(0.2), note(delivered, 1));
    jobs->submit("fast", Time{}, Duration::fromSeconds(0.1), note(delivered, 2));
    EXPECT_FALSE(jobs->idle("slow"));
    jobs->deliverDue(Time::fromSeconds(0.05));
    EXPECT_TRUE(delivered.empty());
    jobs->deliverDue(Time::fromSeconds(0.3));
    EXPECT_EQ(delivered, (Delivered{{2, 100}, {1, 200}}));
    EXPECT_TRUE(jobs->idle("slow"));
  }
}

TEST(LockstepJobs, AreDeliveredInTheOrderOfSubmissionWhenDueTogether) {
  auto jobs = makeLockstepJobs(2);
  Delivered delivered;
  jobs->submit("b", Time{}, Duration::fromSeconds(0.1), note(delivered, 1));
  jobs->submit("a", Time{}, Duration::fromSeconds(0.1), note(delivered, 2));
  jobs->deliverDue(Time::fromSeconds(0.1));
  EXPECT_EQ(delivered, (Delivered{{1, 100}, {2, 100}}));
}

TEST(LockstepJobs, AreDeliveredAtTheTimesOfARecording) {
  auto jobs = makeLockstepJobs(1);
  Delivered delivered;
  jobs->submit("plan", Time::fromSeconds(1.0), Duration::fromSeconds(0.2), note(delivered, 1));
  const JobDelivery early{"plan", 1, Time::fromSeconds(1.0), Time::fromSeconds(1.05)};
  ASSERT_TRUE(jobs->awaits(early));
  jobs->deliver(early);
  EXPECT_EQ(delivered, (Delivered{{1, 1050}}));
  EXPECT_FALSE(jobs->awaits(early)) << "it is delivered already";
  EXPECT_FALSE(jobs->nextDue(Time::fromSeconds(9)));
}

TEST(LockstepJobs, DoNotWaitForARecordedDeliveryOfAnotherJob) {
  auto jobs = makeLockstepJobs(1);
  Delivered delivered;
  jobs->submit("plan", Time::fromSeconds(1.0), Duration::fromSeconds(0.2), note(delivered, 1));
  const Time later = Time::fromSeconds(2.0);
  EXPECT_FALSE(jobs->awaits({"slam", 1, Time::fromSeconds(1.0), later}));
  EXPECT_FALSE(jobs->awaits({"plan", 2, Time::fromSeconds(1.0), later}));
  EXPECT_FALSE(jobs->awaits({"plan", 1, Time::fromSeconds(1.1), later}));
}

/// A flight's time that passes when the test says so.
class HandClock {
 public:
  void set(double s) { ns_ = Time::fromSeconds(s).nanoseconds(); }
  RunningClock reader() {
    return [this] { return Time::fromNanoseconds(ns_); };
  }

 private:
  std::atomic<std::int64_t> ns_{0};
};

/// Waits for a job that is about to be done.
JobDelivery awaited(const JobRunner& jobs, Time now) {
  while (true) {
    if (const auto due = jobs.nextDue(now)) return *due;
    std::this_thread::yield();
  }
}

TEST(WallClockJobs, AreDeliveredInTheOrderOfCompletion) {
  HandClock clock;
  auto jobs = makeWallClockJobs(2, clock.reader());
  Delivered delivered;
  std::promise<void> first_may_end;
  jobs->submit("first", Time{}, Duration::fromSeconds(0.1),
               [&, gate = first_may_end.get_future().share()]() -> JobRunner::Deliver {
                 gate.wait();
                 return [&](Time t) { delivered.emplace_back(1, millisecondsOf(t)); };
               });
  jobs->submit("second", Time{}, Duration::fromSeconds(0.1), note(delivered, 2));
  const JobDelivery due = awaited(*jobs, Time::fromSeconds(0.03));
  EXPECT_EQ(due.kind, "second");
  EXPECT_EQ(due.number, 2u);
  EXPECT_EQ(due.delivered, Time::fromSeconds(0.03)) << "when it is asked for, not when it was declared for";
  jobs->deliver(due);
  EXPECT_FALSE(jobs->idle("first"));
  EXPECT_FALSE(jobs->nextDue(Time::fromSeconds(5))) << "declared for long ago, but it is not done";

  first_may_end.set_value();
  jobs->deliver(awaited(*jobs, Time::fromSeconds(6)));
  EXPECT_EQ(delivered, (Delivered{{2, 30}, {1, 6000}}));
  EXPECT_TRUE(jobs->idle("first"));
}

TEST(WallClockJobs, AreTimedFromSubmissionToTheEndOfTheWork) {
  HandClock clock;
  auto jobs = makeWallClockJobs(1, clock.reader());
  for (int i = 1; i <= 100; ++i) {
    const Time begin = Time::fromSeconds(i);
    clock.set(begin.seconds());
    // The last two take longer than was declared.
    const double takes_s = i <= 98 ? 0.05 : 0.3;
    jobs->submit("plan", begin, Duration::fromSeconds(0.1), [&clock, begin, takes_s]() -> JobRunner::Deliver {
      clock.set(begin.seconds() + takes_s);
      return {};
    });
    jobs->deliver(awaited(*jobs, Time::fromSeconds(i + 0.9)));
  }
  const auto all = jobs->times();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].kind, "plan");
  EXPECT_EQ(all[0].count, 100);
  EXPECT_EQ(all[0].late, 2);
  EXPECT_NEAR(all[0].median.seconds(), 0.05, 1e-6);
  EXPECT_NEAR(all[0].p99.seconds(), 0.3, 1e-6);
  EXPECT_TRUE(all[0].tooSlow());
}

TEST(WallClockJobs, RethrowExceptionsAtDelivery) {
  HandClock clock;
  auto jobs = makeWallClockJobs(1, clock.reader());
  jobs->submit("plan", Time{}, Duration::fromSeconds(0.1),
               []() -> JobRunner::Deliver { throw std::runtime_error("broken"); });
  const JobDelivery due = awaited(*jobs, Time::fromSeconds(1));
  EXPECT_THROW(jobs->deliver(due), std::runtime_error);
}

TEST(JobStopwatch, AllowsOneLateJobInAHundred) {
  JobStopwatch stopwatch;
  for (int i = 0; i < 99; ++i) stopwatch.add("slam", Duration::fromSeconds(0.4), Duration::fromSeconds(0.1));
  stopwatch.add("slam", Duration::fromSeconds(0.4), Duration::fromSeconds(2.0));
  const JobTimes times = stopwatch.times().front();
  EXPECT_EQ(times.late, 1);
  EXPECT_FALSE(times.tooSlow());
  EXPECT_TRUE(JobStopwatch().times().empty());
}

}  // namespace
}  // namespace swiftlet::common
