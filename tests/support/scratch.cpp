#include "tests/support/scratch.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace swiftlet::test_support {

void Scratch::SetUp() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder_ = std::filesystem::temp_directory_path() / "swiftlet_tests" / (name + "-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
}

void Scratch::TearDown() {
  if (!HasFailure()) std::filesystem::remove_all(folder_);
}

std::string Scratch::write(const std::string& name, const std::string& text) const {
  const std::filesystem::path file = folder_ / name;
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

}  // namespace swiftlet::test_support
