// control.tsv reads back as it was written, and tells where it is damaged.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "interfaces/control_log.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

class ControlLog : public test_support::Scratch {
 protected:
  std::string problemOf(const std::string& text) const {
    try {
      (void)readControlLog(write("control.tsv", text));
    } catch (const common::InputError& e) {
      return e.what();
    }
    return "";
  }
};

ControlRow rowAt(int tick) {
  ControlRow row;
  row.stamp = common::Time::fromSeconds(0.01 * tick);
  row.flying = tick > 3;
  row.pitch_rad = 0.01 * tick;
  row.thrust = 0.56;
  row.velocity_odom_m_s = {0.25, -0.5, 0.125};
  row.battery_v = 12.25;
  row.has_truth = true;
  row.true_velocity_map_m_s = {0.5, 0.25, 0};
  return row;
}

TEST_F(ControlLog, ReadsBackAsItWasWritten) {
  {
    auto writer = ControlLogWriter::create(path("control.tsv"));
    ASSERT_TRUE(writer);
    for (int tick = 0; tick < 500; ++tick) ASSERT_TRUE(writer->write(rowAt(tick)));
    ASSERT_TRUE(writer->flush());
  }
  const std::vector<ControlRow> rows = readControlLog(path("control.tsv"));
  ASSERT_EQ(rows.size(), 500U);
  for (int tick : {0, 4, 499}) EXPECT_EQ(toLine(rows[static_cast<std::size_t>(tick)]), toLine(rowAt(tick)));
  EXPECT_EQ(rows[7].stamp, rowAt(7).stamp);
}

TEST_F(ControlLog, TellsWhereItIsDamaged) {
  const std::string good = toLine(rowAt(1));
  EXPECT_THAT(problemOf(good + "0.02 1 nonsense\n"), testing::HasSubstr("control.tsv:2"));
  EXPECT_THAT(problemOf(good + good), testing::HasSubstr("is not later than the line before"));
  std::string nan = good;
  nan.replace(nan.find("0.010000"), 8, "nan");
  EXPECT_THAT(problemOf(nan), testing::HasSubstr("control.tsv:1"));
  std::string absurd = good;
  absurd.replace(absurd.find(" 0.010000 "), 10, " 1e300 ");
  EXPECT_THAT(problemOf(absurd), testing::HasSubstr("pitch: `1e300` is not from -1000000 to 1000000"));
  EXPECT_EQ(problemOf("# nothing\n"), "");
}

TEST_F(ControlLog, EachColumnHasBounds) {
  const auto with = [&](std::size_t column, const std::string& word) {
    std::istringstream words(toLine(rowAt(1)));
    std::string line, next;
    for (std::size_t i = 0; words >> next; ++i) line += (i == column ? word : next) + " ";
    return problemOf(line + "\n");
  };
  EXPECT_EQ(with(1, "1"), "");
  EXPECT_THAT(with(1, "2"), testing::HasSubstr("control.tsv:1:13: flying: `2` is neither 0 nor 1"));
  EXPECT_THAT(with(5, "1.5"), testing::HasSubstr("thrust: `1.5` is not from 0 to 1"));
  EXPECT_THAT(with(6, "1e5"), testing::HasSubstr("tilt_cos: `1e5` is not from -1 to 1"));
  EXPECT_THAT(with(14, "-3"), testing::HasSubstr("battery: `-3` is not from 0 to 100"));
  EXPECT_THAT(with(15, "7"), testing::HasSubstr("truth: `7` is neither 0 nor 1"));
}

}  // namespace
}  // namespace swiftlet::interfaces
