// A run says which build flew it.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "interfaces/run_folder.hpp"
#include "support.hpp"

namespace swiftlet::interfaces {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST(RunVersion, IsInEachFileForPeople) {
  const ScratchFolder folder;
  RunInfo info;
  info.version = {"0.2.0", "5e2b3b0f1c4d", true};
  RunFolder(folder / "run", info, "speed: 1\n").finish({});
  const json mission = json::parse(bytesOf(folder / "run/mission.json"));
  EXPECT_EQ(mission["version"], "0.2.0");
  EXPECT_EQ(mission["commit"], "5e2b3b0f1c4d");
  EXPECT_EQ(mission["dirty"], true);
  const std::string named = "Swiftlet 0.2.0 (commit 5e2b3b0f1c4d, changed)";
  EXPECT_EQ(bytesOf(folder / "run/config.yaml"), "# The settings of a flight with " + named + ".\nspeed: 1\n");
  EXPECT_THAT(bytesOf(folder / "run/report.html"), HasSubstr("<footer>" + named + "</footer>"));
}

TEST(RunVersion, OfSourcesFromNoCheckoutIsUnknown) {
  const ScratchFolder folder;
  RunInfo info;
  info.version.number = "0.2.0";
  RunFolder(folder / "run", info, "").finish({});
  const json mission = json::parse(bytesOf(folder / "run/mission.json"));
  EXPECT_EQ(mission["commit"], "unknown");
  EXPECT_TRUE(mission["dirty"].is_null());
  EXPECT_THAT(bytesOf(folder / "run/config.yaml"),
              StartsWith("# The settings of a flight with Swiftlet 0.2.0 (commit unknown)"));
}

}  // namespace
}  // namespace swiftlet::interfaces
