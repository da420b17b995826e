// A test with a folder of its own, named after it, empty at the start and gone after a pass.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace swiftlet::test_support {

class Scratch : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Writes a file into the folder and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

std::string readText(const std::filesystem::path& file);

}  // namespace swiftlet::test_support
