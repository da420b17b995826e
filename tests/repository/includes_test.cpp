// The arrows between the folders are those of docs/architecture.md, and no others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Arrows arrowsOfTheRepository() { return readArrows(trackedFiles().at("docs/architecture.md")); }

TEST(Includes, FollowTheTableOfTheArchitecture) {
  const auto found = forbiddenArrows(trackedFiles(), arrowsOfTheRepository());
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

TEST(Includes, HaveNoCycle) {
  const auto found = cycles(fileGraph(trackedFiles()));
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

TEST(Includes, TheTableOfTheArchitectureHasNoCycle) { EXPECT_THAT(cycles(arrowsOfTheRepository()), IsEmpty()); }

TEST(Includes, EveryFolderOfCodeIsInTheArchitecture) {
  const Arrows arrows = arrowsOfTheRepository();
  for (const auto& [path, text] : trackedFiles()) {
    const std::string top = topFolderOf(path);
    if (!endsWithAny(path, {".hpp", ".cpp"}) || top == "tests" || top == "benchmarks" || top == "fuzz" ||
        top == "examples")
      continue;
    EXPECT_NE(ownerOf(path, arrows), "") << path << ": its folder is not in the table of docs/architecture.md";
  }
}

// Each part owns its config and types, and the whole includes its parts.
TEST(Includes, NoTwoPartsIncludeEachOther) {
  const std::vector<std::string> found = twoWayPairs(trackedFiles());
  EXPECT_THAT(found, IsEmpty()) << joined(found);
}

TEST(Includes, OnlyTheScorerAndSimulatedFlightsMayUseTheSimulator) {
  for (const auto& [folder, uses] : arrowsOfTheRepository()) {
    if (folder == "evaluation" || folder == "simulated_flight" || folder == "apps") continue;
    EXPECT_FALSE(uses.contains("simulation")) << folder << " would see the ground truth";
  }
}

// Planted mistakes show that the checks above work.
TEST(Includes, APlantedForbiddenIncludeIsCaught) {
  const Arrows arrows = readArrows("| `common` | - |\n| `planning` | common |\n| `perception` | common |\n");
  const Files files = {{"common/time.hpp", "#pragma once\n"},
                       {"planning/path.hpp", "#include <vector>\n#include \"common/time.hpp\"\n"},
                       {"planning/cost.cpp", "// Cost\n\n#include \"perception/fusion/filter.hpp\"\n"},
                       {"perception/sibling.cpp", "#include \"sibling.hpp\"\n"}};
  EXPECT_THAT(forbiddenArrows(files, arrows),
              ElementsAre("perception/sibling.cpp:1: \"sibling.hpp\" is in no folder of the list, or not named from "
                          "the root",
                          "planning/cost.cpp:3: planning may not use perception"));
}

TEST(Includes, APlantedForbiddenIncludeFromAnInnerFolderIsCaught) {
  const Arrows arrows =
      readArrows("| `common` | - |\n| `behaviors` | common, behaviors/tree |\n| `behaviors/tree` | - |\n");
  const Files files = {{"behaviors/hold.cpp", "#include \"behaviors/tree/node.hpp\"\n#include \"common/world.hpp\"\n"},
                       {"behaviors/tree/node.cpp", "#include \"common/world.hpp\"\n"}};
  EXPECT_THAT(forbiddenArrows(files, arrows),
              ElementsAre("behaviors/tree/node.cpp:1: behaviors/tree may not use common"));
}

TEST(Includes, APlantedCycleIsCaught) {
  const Files files = {{"a/one.hpp", "#include \"b/two.hpp\"\n"},
                       {"b/two.hpp", "#include \"c/three.hpp\"\n"},
                       {"c/three.hpp", "#include \"a/one.hpp\"\n"},
                       {"c/four.hpp", "#include \"a/one.hpp\"\n"}};
  EXPECT_THAT(cycles(fileGraph(files)), ElementsAre("a/one.hpp -> b/two.hpp -> c/three.hpp -> a/one.hpp"));
}

TEST(Includes, APlantedPairThatIncludesEachOtherIsCaught) {
  const Files files = {{"a/whole.hpp", ""},
                       {"a/whole.cpp", "#include \"a/whole.hpp\"\n#include \"a/part.hpp\"\n"},
                       {"a/part.hpp", "#include \"a/whole.hpp\"\n"},
                       {"a/part.cpp", "#include \"a/part.hpp\"\n"}};
  EXPECT_THAT(twoWayPairs(files), ElementsAre("a/part <-> a/whole"));
}

// Headers without a source are compiled alone (CMakeLists.txt). Together with this test, every header compiles by
// itself.
TEST(Includes, ASourceIncludesItsOwnHeaderFirst) {
  for (const auto& [path, text] : trackedFiles()) {
    if (!path.ends_with(".cpp") || topFolderOf(path) == "tests" || topFolderOf(path) == "examples") continue;
    const std::string header = path.substr(0, path.size() - 4) + ".hpp";
    if (!trackedFiles().contains(header)) continue;
    for (const std::string& line : linesOf(text)) {
      if (!line.starts_with("#include")) continue;
      EXPECT_EQ(line, "#include \"" + header + "\"") << path << ": its own header comes first, named from the root";
      break;
    }
  }
}

}  // namespace
}  // namespace swiftlet::repository
