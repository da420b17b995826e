// A link that jitters, loses and overtakes scans is no wrong clock; late scans, jumps and drifts are told apart on it.
#include "autonomy/arrivals/laser_clock.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

constexpr double kFault_s = 10.0, kEnd_s = 13.0;

struct Scan {
  double true_s, measured_s, arrived_s;
};

/// Scans at 40 Hz over a link of the nature `real`: 30 to 40 ms, in any order, 1 % lost. The fault changes those that
/// are measured from kFault_s on.
std::vector<Scan> scans(std::uint64_t seed, const std::function<void(Scan&)>& fault) {
  common::RandomStream random(seed, "link", 0);
  std::vector<Scan> all;
  for (double t_s = 0.0; t_s < kEnd_s; t_s += 0.025) {
    const bool lost = random.chance(0.01);
    Scan scan{t_s, t_s, t_s + 0.03 + 0.01 * random.uniform()};
    if (t_s >= kFault_s) fault(scan);
    if (!lost) all.push_back(scan);
  }
  std::stable_sort(all.begin(), all.end(), [](const Scan& a, const Scan& b) { return a.arrived_s < b.arrived_s; });
  return all;
}

struct Outcome {
  ScanTiming named = ScanTiming::kUsual;  ///< The first that was not kUsual.
  double worst_s = 0.0;                   ///< Greatest error of a corrected stamp, half a second after it was named.
};

Outcome outcome(std::uint64_t seed, const std::function<void(Scan&)>& fault) {
  LaserClock clock(0.025);
  Outcome outcome;
  double named_s = 0.0;
  for (const Scan& scan : scans(seed, fault)) {
    const common::Stamps stamps{Time::fromSeconds(scan.measured_s), Time::fromSeconds(scan.arrived_s)};
    clock.add(stamps);
    if (outcome.named == ScanTiming::kUsual && clock.timing() != ScanTiming::kUsual) {
      outcome.named = clock.timing();
      named_s = scan.true_s;
      EXPECT_GE(scan.true_s, kFault_s);
    }
    if (outcome.named != ScanTiming::kUsual && scan.true_s > named_s + 0.5 && clock.isCredible(stamps))
      outcome.worst_s = std::max(outcome.worst_s, std::abs(clock.measured(stamps).seconds() - scan.true_s));
  }
  return outcome;
}

TEST(LaserClock, AnOrdinaryLinkIsNoFault) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(outcome(seed, [](Scan&) {}).named, ScanTiming::kUsual) << seed;
}

TEST(LaserClock, TellsWhatIsWrong) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double late_s : {0.06, 0.3, 1.0})
      EXPECT_EQ(outcome(seed, [=](Scan& scan) { scan.arrived_s += late_s; }).named, ScanTiming::kLate) << late_s;
    for (const double jump_s : {0.3, 0.06, -0.06, -0.3}) {
      const Outcome jumped = outcome(seed, [=](Scan& scan) { scan.measured_s += jump_s; });
      EXPECT_EQ(jumped.named, ScanTiming::kClockJumped) << jump_s << " seed " << seed;
      EXPECT_LT(jumped.worst_s, 0.01) << jump_s << " seed " << seed;
    }
    for (const double drift : {0.1, 0.02, -0.02, -0.1}) {
      const Outcome drifts = outcome(seed, [=](Scan& scan) { scan.measured_s += drift * (scan.true_s - kFault_s); });
      EXPECT_EQ(drifts.named, ScanTiming::kClockDrifts) << drift << " seed " << seed;
      EXPECT_LT(drifts.worst_s, 0.03) << drift << " seed " << seed;
    }
  }
}

TEST(LaserClock, AScanOfTheFutureIsNotCredibleAndChangesNothing) {
  LaserClock clock(0.025);
  for (int i = 0; i < 100; ++i) clock.add({Time::fromSeconds(0.025 * i), Time::fromSeconds(0.025 * i + 0.03)});
  const common::Stamps wrong{Time::fromSeconds(1000.0), Time::fromSeconds(2.53)};
  clock.add(wrong);
  EXPECT_FALSE(clock.isCredible(wrong));
  const common::Stamps next{Time::fromSeconds(2.525), Time::fromSeconds(2.555)};
  clock.add(next);
  EXPECT_TRUE(clock.isCredible(next));
  EXPECT_EQ(clock.timing(), ScanTiming::kUsual);
  EXPECT_EQ(clock.measured(next), next.measured);
}

}  // namespace
}  // namespace swiftlet::autonomy
