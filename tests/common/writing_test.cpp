// How figures and text are written into files.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "common/markup.hpp"
#include "common/rounding.hpp"

namespace swiftlet::common {
namespace {

TEST(Rounding, KeepsAtMostTheRequestedDecimals) {
  EXPECT_EQ(fmt::format("{}", rounded(30.563146064540703)), "30.5631");
  EXPECT_EQ(fmt::format("{}", rounded(0.1 + 0.2, 3)), "0.3");
  EXPECT_FALSE(std::signbit(rounded(-0.00001))) << "no negative zero";
  EXPECT_TRUE(rc::check([] {
    const double value = *rc::gen::inRange(-1'000'000'000, 1'000'000'000) * 1.234567e-4;
    const int decimals = *rc::gen::inRange(0, 6);
    const std::string text = fmt::format("{}", rounded(value, decimals));
    const std::size_t dot = text.find('.');
    RC_ASSERT(dot == std::string::npos || text.size() - dot - 1 <= static_cast<std::size_t>(std::max(1, decimals)));
    RC_ASSERT(std::abs(rounded(value, decimals) - value) <= 0.5 * std::pow(10.0, -decimals) + 1e-9);
  }));
}

TEST(Rounding, DoesNotChangeTextWithoutDecimals) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(rounded(infinity), infinity);
  EXPECT_EQ(rounded(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(rounded(std::nan(""))));
  EXPECT_EQ(rounded(1.2345678901234567e15), 1.2345678901234567e15);
}

TEST(Markup, EscapesAndRepairsText) {
  EXPECT_EQ(escaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(escaped("é \xE2\x82\xAC"), "é \xE2\x82\xAC");
  EXPECT_EQ(escaped("x\xff\xC3"), "x\xEF\xBF\xBD\xEF\xBF\xBD");
}

}  // namespace
}  // namespace swiftlet::common
