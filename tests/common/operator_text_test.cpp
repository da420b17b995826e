// What the operator is told: alarms, and messages without folders and options.
#include "common/operator_text.hpp"

#include <gtest/gtest.h>

#include "common/event.hpp"

namespace swiftlet::common {
namespace {

TEST(Alarm, IsEveryConcernOfWhichAnEventWarns) {
  const auto alarm = [](Severity severity, Concern concern) {
    return alarmOf({{}, severity, "supervisor", "turn back", "", "", concern});
  };
  EXPECT_EQ(alarm(Severity::kWarning, Concern::kTurnBack), "turn back");
  EXPECT_EQ(alarm(Severity::kError, Concern::kEstimate), "estimate degraded");
  EXPECT_EQ(alarm(Severity::kInfo, Concern::kEstimate), "") << "it is good again";
  EXPECT_EQ(alarm(Severity::kWarning, Concern::kNone), "") << "a warning that asks nobody to look up";
}

TEST(OperatorText, NamesFilesWithoutTheirFolders) {
  EXPECT_EQ(withoutFolders("/srv/kim/hall/map.yaml:3:7: image: no free cells"), "map.yaml:3:7: image: no free cells");
  EXPECT_EQ(withoutFolders("map `hall/map.yaml` and ../a/b.xml, ~/runs/x"), "map `map.yaml` and b.xml, x");
  EXPECT_EQ(withoutFolders("runs/first/events.jsonl: No space left on device"),
            "events.jsonl: No space left on device");
  EXPECT_EQ(withoutFolders("/tmp/Müller/plan.xml"), "plan.xml");
  for (const char* plain :
       {"0.10 m/s", "1.5 m/s^2 and/or 3 m", "(3.00, -1.50) m", "http://vehicle.local/page", "", "/"})
    EXPECT_EQ(withoutFolders(plain), plain);
}

TEST(OperatorText, LeavesOutHintsForTheCommandLine) {
  const Problem no_map{{"/srv/missions/find.xml", 4, 2},
                       "Localize",
                       Message("test.no-map", "the flight has no map"),
                       "give it one: fly --map M"};
  EXPECT_EQ(forOperator(no_map), "find.xml:4:2: Localize: the flight has no map");
  const Problem typed{
      {"find.xml", 4, 2}, "height_m", Message("test.range", "`0.1` is out of range"), "did you mean `1.0`?"};
  EXPECT_EQ(forOperator(InputError(std::vector{typed, no_map})),
            "find.xml:4:2: height_m: `0.1` is out of range, did you mean `1.0`? (and 1 more)");
}

}  // namespace
}  // namespace swiftlet::common
