// The events for the pages: a page gets each once, and a new page the last ones.
#include "web/server/event_feed.hpp"

#include <gtest/gtest.h>

namespace swiftlet::web {
namespace {

common::Event eventNamed(const std::string& text) {
  return {common::Time{}, common::Severity::kInfo, "mission", text, ""};
}

TEST(EventFeedTest, APageGetsTheEventsAfterItsLastOne) {
  EventFeed feed;
  EXPECT_TRUE(feed.after(0).empty());
  for (const char* text : {"a", "b", "c"}) feed.post(eventNamed(text));
  const auto rest = feed.after(1);
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[0].number, 2u);
  EXPECT_EQ(rest[0].event.text, "b");
  EXPECT_EQ(rest[1].event.text, "c");
  EXPECT_TRUE(feed.after(3).empty());
}

TEST(EventFeedTest, TheNumbersGoOnWhereOldEventsAreDropped) {
  EventFeed feed;
  for (std::size_t i = 1; i <= EventFeed::kKept + 3; ++i) feed.post(eventNamed(std::to_string(i)));
  const auto all = feed.after(0);
  ASSERT_EQ(all.size(), EventFeed::kKept);
  EXPECT_EQ(all.front().number, 4u);
  EXPECT_EQ(all.front().event.text, "4");
  EXPECT_EQ(all.back().number, EventFeed::kKept + 3);
}

}  // namespace
}  // namespace swiftlet::web
