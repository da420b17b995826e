// events.jsonl: one event a line, whatever the text.
#include "interfaces/files/json_lines.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Severity;
using common::Time;
using testing::HasSubstr;

TEST(Events, AreOneLineOfJsonEach) {
  EXPECT_EQ(toJson({Time::fromSeconds(12.5), Severity::kWarning, "flight", "held", "laser silent"}),
            R"({"t_s":12.5,"severity":"warning","source":"flight","text":"held","reason":"laser silent"})");
  for (int ms = 1; ms < 100'000; ms += 7)
    EXPECT_LE(toJson({Time::fromNanoseconds(std::int64_t{1'000'000} * ms), Severity::kInfo, "", "", ""}).find(','), 14u)
        << ms << " ms";
}

TEST(Events, NameTheVehicleOnlyWhereThereAreSeveral) {
  const ScratchFolder folder;
  const common::Event event{Time::fromSeconds(1), Severity::kInfo, "flight", "landed", "", "second"};
  EXPECT_EQ(toJson(event),
            R"({"t_s":1.0,"severity":"info","source":"flight","text":"landed","reason":"","vehicle":"second"})");
  put(folder / "e.jsonl", toJson(event) + "\n" + toJson({event.stamp, Severity::kInfo, "a", "b", ""}) + "\n");
  const auto events = readEvents(folder / "e.jsonl");
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].vehicle, "second");
  EXPECT_EQ(events[1].vehicle, "");
}

TEST(Events, StayOnOneLineWhateverTheirText) {
  const ScratchFolder folder;
  const std::string odd = "two\nlines, \"quoted\", \t tab, \xff no UTF-8, é";
  auto writer = EventWriter::create(folder / "e.jsonl");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write({Time::fromNanoseconds(1), Severity::kInfo, "mission", odd, ""}));
  ASSERT_TRUE(writer->write({Time::fromNanoseconds(2), Severity::kError, "x", "second", "why"}));
  const auto events = readEvents(folder / "e.jsonl");
  ASSERT_EQ(events.size(), 2u);
  EXPECT_THAT(events[0].text, HasSubstr("two\nlines, \"quoted\", \t tab"));
  EXPECT_EQ(events[1].severity, Severity::kError);
  EXPECT_EQ(events[1].stamp, Time::fromNanoseconds(2));
  EXPECT_EQ(events[1].reason, "why");
}

TEST(Events, LeaveOutATruncatedLastLine) {
  const ScratchFolder folder;
  const std::string line = toJson({Time::fromSeconds(1), Severity::kInfo, "a", "b", ""});
  put(folder / "e.jsonl", line + "\n" + line.substr(0, 20));
  EXPECT_EQ(readEvents(folder / "e.jsonl").size(), 1u);
}

TEST(Events, ReportThePlaceOfMistakes) {
  const ScratchFolder folder;
  const std::string line = toJson({Time::fromSeconds(1), Severity::kInfo, "a", "b", ""});
  const auto problem = [&](const std::string& second) {
    put(folder / "e.jsonl", line + "\n" + second + "\n");
    return problemOf([&] { readEvents(folder / "e.jsonl"); });
  };
  EXPECT_THAT(problem("not json"), HasSubstr("e.jsonl:2: event: "));
  EXPECT_THAT(problem(R"({"t_s": 1})"), HasSubstr("e.jsonl:2: event: "));
  EXPECT_THAT(problem(R"({"t_s":1e300,"severity":"info","source":"a","text":"b"})"), HasSubstr("no time of a flight"));
  EXPECT_THAT(problem(R"({"t_s":1,"severity":"loud","source":"a","text":"b"})"), HasSubstr("unknown severity `loud`"));
}

}  // namespace
}  // namespace swiftlet::interfaces
