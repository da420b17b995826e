// The published figures of docs/localization.md, on fewer cases; SWIFTLET_LOST_CASES sets how many of each kind.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/localization/lost_cases.hpp"

namespace swiftlet::test {
namespace {

/// The log-odds were fitted on seeds 1 to 20: other buildings, other walks.
constexpr std::uint64_t kFirstSeed = 1001;

int casesOfEach() {
  const char* text = std::getenv("SWIFTLET_LOST_CASES");
  return text != nullptr ? std::max(1, std::atoi(text)) : 12;
}

struct Total {
  int cases = 0, wrong = 0, noticed = 0, alarms = 0, false_alarms = 0, scans = 0, localized = 0, false_scans = 0;
  int refuted = 0;
  double worst_delay_s = 0.0;

  void add(const CaseResult& result) {
    ++cases;
    wrong += result.wrong;
    noticed += result.noticed;
    alarms += result.alarms;
    false_alarms += result.false_alarms;
    scans += result.scans;
    localized += result.localized;
    false_scans += result.falsely_localized;
    refuted += result.refuted ? 1 : 0;
    worst_delay_s = std::max(worst_delay_s, result.worst_delay_s);
  }
  void print(const char* name) const {
    std::printf("| %-28s | %5d | %5d | %7d | %6d | %5d | %5.1f | %5.1f %% | %4.2f %% | %7d |\n", name, cases, wrong,
                noticed, alarms, false_alarms, worst_delay_s, 100.0 * localized / scans, 100.0 * false_scans / scans,
                refuted);
  }
};

TEST(Lost, IsReportedWhenThePoseIsWrongAndOnlyThen) {
  Total all;
  std::printf(
      "| case                         | cases | wrong | noticed | alarms | false | worst s | localized | falsely | "
      "refuted |\n");
  for (const CaseKind kind : {CaseKind::kUndisturbed, CaseKind::kChangedFurniture, CaseKind::kKidnapped,
                              CaseKind::kKidnappedChanged, CaseKind::kWrongMap, CaseKind::kTwin}) {
    Total total;
    for (int i = 0; i < casesOfEach(); ++i) {
      LostCase lost_case(kind, kFirstSeed + static_cast<std::uint64_t>(i));
      const CaseResult result = lost_case.run(16.0);
      total.add(result);
      all.add(result);
      if (result.noticed == result.wrong && result.false_alarms == 0) continue;
      std::printf("  seed %llu\n", static_cast<unsigned long long>(result.seed));
      for (const std::string& line : result.story) std::printf("    %s\n", line.c_str());
    }
    total.print(toString(kind));
    if (kind == CaseKind::kWrongMap)
      EXPECT_GE(total.refuted, total.cases / 2) << "in 16 s";
    else
      EXPECT_EQ(total.refuted, 0) << toString(kind);
    std::fflush(stdout);
  }
  all.print("all");
  ASSERT_GT(all.wrong, 0);
  ASSERT_GT(all.alarms, 0);
  EXPECT_GE(1.0 - static_cast<double>(all.false_alarms) / all.alarms, 0.95) << "precision";
  EXPECT_GE(static_cast<double>(all.noticed) / all.wrong, 0.90) << "recall";
}

}  // namespace
}  // namespace swiftlet::test
