// events.jsonl: one event a line, whatever the text.
#include "interfaces/files/json_lines.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Severity;
using common::Time;
using nlohmann::json;
using testing::HasSubstr;

TEST(Events, AreOneLineOfJsonEach) {
  EXPECT_EQ(toJson({Time::fromSeconds(12.5), Severity::kWarning, "flight", "held", "laser silent"}),
            R"({"t_s":12.5,"severity":"warning","source":"flight","text":"held","reason":"laser silent"})");
  for (int ms = 1; ms < 100'000; ms += 7)
    EXPECT_LE(toJson({Time::fromNanoseconds(std::int64_t{1'000'000} * ms), Severity::kInfo, "", "", ""}).find(','), 14u)
        << ms << " ms";
}

TEST(Events, NameTheVehicleOnlyWhereThereAreSeveral) {
  const common::Event event{Time::fromSeconds(1), Severity::kInfo, "flight", "landed", "", "second"};
  EXPECT_EQ(toJson(event),
            R"({"t_s":1.0,"severity":"info","source":"flight","text":"landed","reason":"","vehicle":"second"})");
  EXPECT_EQ(toJson({event.stamp, Severity::kInfo, "a", "b", ""}).find("vehicle"), std::string::npos);
}

TEST(Events, NameTheAlarmOnlyWhereThereIsOne) {
  const common::Event event{Time::fromSeconds(1),     Severity::kWarning, "supervisor", "land", "why", "",
                            common::Concern::kLanding};
  EXPECT_EQ(json::parse(toJson(event))["alarm"], "landing");
}

TEST(Events, StayOnOneLineWhateverTheirText) {
  const ScratchFolder folder;
  const std::string odd = "two\nlines, \"quoted\", \t tab, \xff no UTF-8, é";
  auto writer = EventWriter::create(folder / "e.jsonl");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write({Time::fromNanoseconds(1), Severity::kInfo, "mission", odd, ""}));
  ASSERT_TRUE(writer->write({Time::fromNanoseconds(2), Severity::kError, "x", "second", "why"}));
  const std::vector<json> events = linesOfJson(folder / "e.jsonl");
  ASSERT_EQ(events.size(), 2u);
  EXPECT_THAT(events[0]["text"].get<std::string>(), HasSubstr("two\nlines, \"quoted\", \t tab"));
  EXPECT_EQ(events[1]["severity"], "error");
  EXPECT_EQ(events[1]["t_s"], 2e-9);
  EXPECT_EQ(events[1]["reason"], "why");
}

}  // namespace
}  // namespace swiftlet::interfaces
