// Values and units as they are written, and words that are nearly right.
#include <gtest/gtest.h>

#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/value.hpp"

namespace swiftlet::tree::testing {
namespace {

TEST(Suggestions, ConsiderUnitCaseAndEditDistance) {
  const std::vector<std::string> names = {"clearance_m", "tolerance_m", "TakeOff", "goal"};
  EXPECT_EQ(didYouMean("clearance_mm", names), "did you mean `clearance_m`?");
  EXPECT_EQ(didYouMean("tolerance", names), "did you mean `tolerance_m`?");
  EXPECT_EQ(didYouMean("takeoff", names), "did you mean `TakeOff`?");
  EXPECT_EQ(didYouMean("takeof", names), "did you mean `TakeOff`?");
  EXPECT_EQ(didYouMean("entirely_else", names), "");
  EXPECT_EQ(didYouMean("", names), "");
  const std::vector<std::string> lens = {"k1", "k2", "fx_px", "cx_px"};
  EXPECT_EQ(didYouMean("fx", lens), "did you mean `fx_px`?");
  EXPECT_EQ(didYouMean("k9", lens), "did you mean `k1`?");
  EXPECT_EQ(didYouMean("zz", lens), "") << "no letter is alike";
}

TEST(Values, UnitsAreReadFromNames) {
  EXPECT_EQ(unitOf("speed_m_s"), "m_s");
  EXPECT_EQ(unitOf("msec"), "msec");
  EXPECT_EQ(unitOf("delay_msec"), "msec");
  EXPECT_EQ(unitOf("num_cycles"), "");
  EXPECT_EQ(withoutUnit("speed_m_s"), "speed");
  EXPECT_EQ(withoutUnit("msec"), "msec");
}

TEST(Values, AreReadByTheirType) {
  EXPECT_EQ(parseValue("1.5", PortType::kDuration, "s"), Value(Duration{1'500'000'000}));
  EXPECT_EQ(parseValue("2", PortType::kDuration, "min"), Value(Duration{120'000'000'000}));
  EXPECT_EQ(parseValue("1e30", PortType::kDuration, "s"), std::nullopt);
  EXPECT_EQ(parseValue("1", PortType::kDuration, ""), std::nullopt);
  EXPECT_EQ(parseValue(" -1.5;2 ; 3e0", PortType::kPoint, ""), Value(Point{-1.5, 2.0, 3.0}));
  EXPECT_EQ(parseValue("1;2|3;4;5 | -6;7", PortType::kPoints, ""),
            Value(Points{{{1.0, 2.0, std::nullopt}, {3.0, 4.0, 5.0}, {-6.0, 7.0, std::nullopt}}}));
  for (const char* wrong : {"", "|", "1;2|", "1;2||3;4", "1;2|3", "1;2,3;4"})
    EXPECT_EQ(parseValue(wrong, PortType::kPoints, ""), std::nullopt) << wrong;
  EXPECT_EQ(toString(Value(Points{{{1.0, 2.0, std::nullopt}, {3.0, 4.0, 5.0}}})), "1;2 | 3;4;5");
  EXPECT_EQ(parseValue("-2; 0;3 ;1.5", PortType::kRectangle, ""), Value(Rectangle{-2.0, 0.0, 3.0, 1.5}));
  for (const char* wrong : {"", "1;2;3", "0;0;1;1;1", "0;0;1;", "3;0;-2;1", "0;1;1;1", "0;0;inf;1", "0,0,1,1"})
    EXPECT_EQ(parseValue(wrong, PortType::kRectangle, ""), std::nullopt) << wrong;
  EXPECT_EQ(toString(Value(Rectangle{-2.0, 0.0, 3.0, 1.5})), "-2;0;3;1.5");
  EXPECT_EQ(parseValue("99999999999999999999", PortType::kInt, ""), std::nullopt);
  EXPECT_EQ(toString(Value(Point{1.0, -2.5, std::nullopt})), "1;-2.5");
}

}  // namespace
}  // namespace swiftlet::tree::testing
