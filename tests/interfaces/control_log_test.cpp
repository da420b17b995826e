// control.tsv reads back as it was written, and tells where it is damaged.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "interfaces/control_log.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using testing::IsEmpty;

class ControlLog : public test_support::Scratch {
 protected:
  std::vector<common::Problem> refusalOf(const std::string& text) const {
    return test_support::problemsOf([&] { (void)readControlLog(write("control.tsv", text)); });
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
  EXPECT_THAT(refusalOf(good + "0.02 1 nonsense\n"), HasProblem("text.number-count", "control.tsv:2:8: tick"));
  EXPECT_THAT(refusalOf(good + good), HasProblem("control-log.not-later", "control.tsv:2:1: t"));
  std::string nan = good;
  nan.replace(nan.find("0.010000"), 8, "nan");
  EXPECT_THAT(refusalOf(nan), HasProblem("text.not-a-time", "control.tsv:1:1: t"));
  std::string absurd = good;
  absurd.replace(absurd.find(" 0.010000 "), 10, " 1e300 ");
  EXPECT_THAT(refusalOf(absurd), HasProblem("text.out-of-bounds", "pitch"));
  EXPECT_THAT(refusalOf("# nothing\n"), IsEmpty());
}

TEST_F(ControlLog, EachColumnHasBounds) {
  const auto with = [&](std::size_t column, const std::string& word) {
    std::istringstream words(toLine(rowAt(1)));
    std::string line, next;
    for (std::size_t i = 0; words >> next; ++i) line += (i == column ? word : next) + " ";
    return refusalOf(line + "\n");
  };
  EXPECT_THAT(with(1, "1"), IsEmpty());
  EXPECT_THAT(with(1, "2"), HasProblem("text.no-flag", "control.tsv:1:13: flying"));
  EXPECT_THAT(with(5, "1.5"), HasProblem("text.out-of-bounds", "thrust"));
  EXPECT_THAT(with(6, "1e5"), HasProblem("text.out-of-bounds", "tilt_cos"));
  EXPECT_THAT(with(14, "-3"), HasProblem("text.out-of-bounds", "battery"));
  EXPECT_THAT(with(15, "7"), HasProblem("text.no-flag", "truth"));
}

}  // namespace
}  // namespace swiftlet::interfaces
