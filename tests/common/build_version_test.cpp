#include "common/build_version.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

TEST(BuildVersion, SaysWhatItWasBuiltFrom) {
  EXPECT_EQ(toString(BuildVersion{"0.2.0", "5e2b3b0f1c4d", false}), "0.2.0 (commit 5e2b3b0f1c4d)");
  EXPECT_EQ(toString(BuildVersion{"0.2.0", "5e2b3b0f1c4d", true}), "0.2.0 (commit 5e2b3b0f1c4d, changed)");
  EXPECT_EQ(toString(BuildVersion{.number = "0.2.0"}), "0.2.0 (commit unknown)");
}

}  // namespace
}  // namespace swiftlet::common
