#include "apps/log_variations.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::apps {
namespace {

using common::Duration;
using common::Time;

// Twice the standard deviation of the lasers of these logs (SICK LMS 200, 5 mm up to 8 m by its data sheet).
constexpr double kNoise_m = 0.01;
constexpr std::size_t kFirstScan = 37, kEachLost = 20, kEachKept = 2;
// A slow laser on a busy computer: 5 Hz, and almost two periods late at most.
constexpr double kPeriod_s = 0.2;
constexpr double kLatest_s = 0.35;
constexpr Duration kLeastInterval = Duration::fromMilliseconds(6);

void stampAt(KnownScan& scan, Time stamp) { scan.logged.scan.stamps = {stamp, stamp}; }

void stampGrowing(KnownScans& scans) {
  Time last, now;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Time stamp = scans[i].logged.scan.stamps.measured;
    if (i == 0) {
      now = stamp;
    } else {
      const Duration interval = stamp - last;
      now += std::max({interval, Duration() - interval, Duration::fromMilliseconds(1)});
    }
    last = stamp;
    stampAt(scans[i], now);
  }
}

template <typename IsKept>
void keep(KnownScans& scans, IsKept is_kept) {
  KnownScans rest;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (is_kept(i)) rest.push_back(std::move(scans[i]));
  scans = std::move(rest);
}

void asTheyAre(KnownScans&) {}

void startLater(KnownScans& scans) {
  keep(scans, [](std::size_t i) { return i >= kFirstScan; });
}

void loseSome(KnownScans& scans) {
  keep(scans, [](std::size_t i) { return i % kEachLost != kEachLost - 1; });
}

void keepEverySecond(KnownScans& scans) {
  keep(scans, [](std::size_t i) { return i % kEachKept == 0; });
}

void addNoise(KnownScans& scans) {
  common::RandomStream random(1, "noise");
  for (KnownScan& scan : scans)
    for (float& range_m : scan.logged.scan.ranges_m) range_m += static_cast<float>(kNoise_m * random.gaussian());
}

/// As if taken at an even rate and stamped when they came.
void stampLate(KnownScans& scans) {
  common::RandomStream random(1, "delays");
  Time last;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Time late = Time::fromSeconds(kPeriod_s * static_cast<double>(i) + random.uniform(0.0, kLatest_s));
    last = i == 0 ? late : std::max(late, last + kLeastInterval);
    stampAt(scans[i], last);
  }
}

}  // namespace

const std::vector<LogVariation>& logVariations() {
  static const std::vector<LogVariation> variations{{"growing stamps", asTheyAre},
                                                    {"from the 38th scan on", startLater},
                                                    {"without every 20th scan", loseSome},
                                                    {"every second scan", keepEverySecond},
                                                    {"1 cm of noise more", addNoise},
                                                    {"stamped up to 0.35 s late", stampLate}};
  return variations;
}

KnownScans varied(KnownScans scans, const LogVariation& variation) {
  stampGrowing(scans);
  variation.vary(scans);
  return scans;
}

}  // namespace swiftlet::apps
