#include "common/data_paths.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "common/error.hpp"
#include "common/file_address.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::common {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::problemsOf;

namespace fs = std::filesystem;

/// A folder of data that $SWIFTLET_DATA points to while the test runs.
class DataPaths : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("swiftlet_data_paths_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "missions");
    std::ofstream(folder_ / "missions/only_here.xml") << "<root/>";
    std::ofstream(folder_ / "CMakeLists.txt") << "# Not the one of the source tree.";
    setenv("SWIFTLET_DATA", folder_.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("SWIFTLET_DATA");
    fs::remove_all(folder_);
  }

  fs::path folder_;
};

TEST_F(DataPaths, TheEnvironmentComesBeforeTheSourceTree) {
  EXPECT_EQ(findData("missions/only_here.xml"), folder_ / "missions/only_here.xml");
  const fs::path before = fs::current_path();
  fs::current_path(fs::temp_directory_path());
  EXPECT_EQ(findData("CMakeLists.txt"), folder_ / "CMakeLists.txt");
  fs::current_path(before);
}

TEST_F(DataPaths, TheCurrentFolderComesFirst) {
  const fs::path before = fs::current_path();
  fs::create_directories(folder_ / "here/missions");
  std::ofstream(folder_ / "here/missions/only_here.xml") << "<root/>";
  fs::current_path(folder_ / "here");
  EXPECT_EQ(findData("missions/only_here.xml"), "missions/only_here.xml");
  fs::current_path(before);
}

TEST_F(DataPaths, TheSourceTreeIsFoundFromAnyFolder) {
  const fs::path before = fs::current_path();
  fs::current_path("/");
  EXPECT_TRUE(
      fs::equivalent(findData("common/data_paths.hpp"), fs::path(SWIFTLET_SOURCE_DIR) / "common/data_paths.hpp"));
  fs::current_path(before);
}

TEST_F(DataPaths, AbsolutePathsAreNotChanged) {
  EXPECT_EQ(findData(folder_ / "missions"), folder_ / "missions");
  EXPECT_THROW(findData(folder_ / "missions/other.xml"), InputError);
}

TEST_F(DataPaths, AnAddressIsThePathInIt) {
  fs::create_directories(folder_ / "my data");
  std::ofstream(folder_ / "my data/a%b.xml") << "<root/>";
  const std::string address = "file://" + folder_.string() + "/my%20data/a%25b.xml";
  EXPECT_EQ(findData(address), folder_ / "my data/a%b.xml");
  EXPECT_EQ(findBeside("/", address), folder_ / "my data/a%b.xml");
  EXPECT_EQ(findData("FILE://localhost" + folder_.string() + "/missions"), folder_ / "missions");
  EXPECT_EQ(pathOfAddress("file://beside.xml"), "beside.xml");
  for (const char* name : {"my%20data.xml", "https://host/a%20b", "file:a"}) EXPECT_EQ(pathOfAddress(name), name);
}

TEST_F(DataPaths, BesideAFileItsFolderIsNamedAndSearchedForSuggestions) {
  fs::create_directories(folder_ / "trials");
  std::ofstream(folder_ / "trials/hop_there.xml") << "<root/>";
  EXPECT_EQ(findBeside(folder_ / "trials", "hop_there.xml"), folder_ / "trials/hop_there.xml");
  EXPECT_EQ(findBeside(folder_ / "trials", "missions/only_here.xml"), folder_ / "missions/only_here.xml");
  const auto problems = problemsOf([&] { findBeside(folder_ / "trials", "hop_their.xml"); });
  EXPECT_THAT(problems, HasProblem("file.missing-in", "", (folder_ / "trials").string() + " or this folder"));
  EXPECT_THAT(problems, HasProblem("file.missing-in", "", "`hop_there.xml`"));
}

TEST_F(DataPaths, AMissingFileGetsASuggestion) {
  const auto problems = problemsOf([] { findData("missions/only_hare.xml"); });
  EXPECT_THAT(problems, HasProblem("file.missing-in", "missions/only_hare.xml", "`missions/only_here.xml`"));
  EXPECT_THAT(problems, HasProblem("file.missing-in", "missions/only_hare.xml", folder_.string()));
}

TEST_F(DataPaths, ALinkThatLeadsToNothingIsNotMissing) {
  fs::create_symlink("../.git/annex/objects/K/K.xml", folder_ / "missions/linked.xml");
  EXPECT_THAT(problemsOf([] { findData("missions/linked.xml"); }), HasProblem("file.broken-link"));
}

TEST_F(DataPaths, ANameWithoutItsFolderOrItsEndingGetsASuggestion) {
  fs::create_directories(folder_ / "missions/deep/below");
  std::ofstream(folder_ / "missions/deep/below/one.two.xml") << "<root/>";
  for (const auto& [given, meant] : {std::pair{"mission/only_here.xml", "missions/only_here.xml"},
                                     {"misions/only_hare.xml", "missions/only_here.xml"},
                                     {"missions/only_here", "missions/only_here.xml"},
                                     {"missions/only_here.yaml", "missions/only_here.xml"},
                                     {"only_here.xml", "missions/only_here.xml"},
                                     {"missions/depe/belwo/one.two", "missions/deep/below/one.two.xml"}})
    EXPECT_THAT(problemsOf([name = given] { findData(name); }),
                HasProblem("file.missing-in", given, "`" + std::string(meant) + "`"));
}

TEST_F(DataPaths, WhereNoNameIsAlikeTheFewThatAreThereAreListed) {
  const auto problems = problemsOf([] { findData("missions/zebra.xml"); });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].hint, testing::HasSubstr("missions has "));
  EXPECT_THAT(problems[0].hint, testing::HasSubstr("only_here.xml"));
  EXPECT_THAT(problems[0].hint, testing::Not(testing::HasSubstr("did you mean")));
}

TEST_F(DataPaths, ALoopOfLinksIsToldAsOne) {
  fs::create_symlink("loop.xml", folder_ / "missions/loop.xml");
  const auto problems = problemsOf([&] { findData(folder_ / "missions/loop.xml"); });
  EXPECT_THAT(problems, HasProblem("file.not-reached", "loop.xml", "symbolic links"));
  EXPECT_THAT(problems, testing::Not(HasProblem(kAnyName, "", "did you mean")));
}

TEST_F(DataPaths, AnEmptyNameIsNotFound) { EXPECT_THROW(findData(""), InputError); }

}  // namespace
}  // namespace swiftlet::common
