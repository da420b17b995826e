// Where a run may be written.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "common/error.hpp"
#include "interfaces/run_folder.hpp"
#include "support.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using test_support::HasProblem;
using test_support::problemsOf;

TEST(RunPlace, RefusesForeignFolders) {
  const ScratchFolder folder;
  const auto problem = [&](const fs::path& path) { return problemsOf([&] { RunFolder(path, RunInfo(), ""); }); };
  put(folder / "home/thesis.tex", "years of work");
  put(folder / "home/map.pgm", "a map");
  EXPECT_THAT(problem(folder / "home"), HasProblem("run.other-file"));
  EXPECT_EQ(bytesOf(folder / "home/map.pgm"), "a map") << "nothing is touched";
  fs::create_directories(folder / "nested/map.pgm");
  EXPECT_THAT(problem(folder / "nested"), HasProblem("run.other-file"));
  put(folder / "mine/config.yaml", "laser: urg_04lx");
  EXPECT_THAT(problem(folder / "mine"), HasProblem("run.none"));
  EXPECT_EQ(bytesOf(folder / "mine/config.yaml"), "laser: urg_04lx") << "a name of ours makes it no file of ours";
  put(folder / "file", "");
  EXPECT_THAT(problem(folder / "file"), HasProblem("folder.none", "file"));
  EXPECT_THAT(problem(folder / "file/below"), HasProblem("folder.below-file"));
}

TEST(RunPlace, IsWrittenByOneFlightAtATime) {
  const ScratchFolder folder;
  {
    const RunFolder first(folder / "run", RunInfo(), "");
    EXPECT_THROW(RunFolder(folder / "run", RunInfo(), ""), common::InputError);
    EXPECT_TRUE(fs::exists(folder / "run/mission.json"));
  }
  EXPECT_NO_THROW(RunFolder(folder / "run", RunInfo(), ""));
}

TEST(RunPlace, GivesEachRunANewName) {
  const ScratchFolder folder;
  const auto fresh = [&] { return freshRunFolder(folder, "2025-01-31T14:05:09", "explore and/return"); };
  const fs::path first = fresh();
  EXPECT_EQ(first.filename(), "2025-01-31T14-05-09-explore-and-return");
  EXPECT_EQ(first.parent_path(), folder.path());
  EXPECT_TRUE(fs::is_directory(first));
  EXPECT_EQ(fresh().filename(), "2025-01-31T14-05-09-explore-and-return-2");
}

}  // namespace
}  // namespace swiftlet::interfaces
