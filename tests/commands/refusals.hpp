// The fixtures of tests of what a command refuses.
#pragma once

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {

class Refusals : public test_support::Scratch {
 protected:
  /// Expects exit code 2 and a message like this.
  static void expectRefused(const test_support::ProgramEnd& end, const std::string& pattern) {
    EXPECT_EQ(end.exit_code, 2) << test_support::describe(end);
    EXPECT_THAT(end.err, testing::ContainsRegex(pattern));
  }
};

class RefusalsBeforeWriting : public Refusals {
 protected:
  /// Expects a refusal with a message like this before anything was written to `run`.
  void expectRefused(const test_support::ProgramEnd& end, const std::string& pattern) const {
    Refusals::expectRefused(end, pattern);
    EXPECT_FALSE(std::filesystem::exists(path("run"))) << "something was written: " << test_support::describe(end);
  }
};

}  // namespace swiftlet::commands
