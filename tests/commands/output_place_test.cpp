// Where results cannot be written: every command says so, with the true reason, before its work.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/commands/missions.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::runSwiftlet;

class OutputPlace : public Refusals {
 protected:
  void SetUp() override {
    Refusals::SetUp();
    hop_ = write("hop.xml", missionWith(kHop));
    trial_ = write("t.yaml", "mission: " + hop_ + "\nscenario: {world: " + write("w.sdf", worldWith(room())) + "}\n");
    log_ = write("a.clf", "FLASER 3 1.0 1.0 1.0 0 0 0 0 0 0 0.1 host 0.1\n");
    graph_ = write("a.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n");
  }
  void expectRefusedByAll(const std::string& place, const std::string& says) const {
    expectRefused(runSwiftlet({"fly", hop_, "--headless", "--out", place}), says);
    expectRefused(runSwiftlet({"trial", trial_, "--out", place}), says);
    expectRefused(runSwiftlet({"map", log_, "--out", place}), says);
    expectRefused(runSwiftlet({"optimize", graph_, "--out", place}), says);
  }

  std::string hop_, trial_, log_, graph_;
};

TEST_F(OutputPlace, AFolderOfTheKernelHoldsNoFiles) {
  expectRefusedByAll("/proc/x", "/proc/x: .*`/proc` holds no files of users.*give a folder on a disk");
  expectRefusedByAll("/sys/x/y", "/sys/x/y: .*`/sys` holds no files of users");
}

TEST_F(OutputPlace, BelowAFileNoFolderCanBeMade) {
  write("taken", "mine");
  expectRefusedByAll(path("taken/below"), "taken` is a file, and no folder can be made there");
}

TEST_F(OutputPlace, ALinkToNothingIsNamed) {
  fs::create_symlink(path("nowhere"), path("link"));
  expectRefusedByAll(path("link"), "link` is a link to what is not there");
}

TEST_F(OutputPlace, AFolderOfSomebodyElseIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::create_directory(path("theirs"));
  fs::permissions(path("theirs"), fs::perms::owner_read | fs::perms::owner_exec);
  expectRefusedByAll(path("theirs/x"),
                     "nothing can be written to `.*theirs`: Permission denied, give a folder of yours");
}

TEST_F(OutputPlace, FilesAreTriedBeforeTheWorkToo) {
  const std::string says = "`/proc` holds no files of users";
  expectRefused(runSwiftlet({"convert", write("a.ply", ""), "/proc/a.bt"}), says);
  expectRefused(runSwiftlet({"migrate", hop_, "--out", "/proc/new.xml"}), says);
  expectRefused(runSwiftlet({"check", hop_, "--draw", "/proc/tree.svg"}), says);
  expectRefused(runSwiftlet({"identify", path("run"), "--out", "/proc/model.yaml"}), says);
  expectRefused(runSwiftlet({"tune", path("run"), "--out", "/proc/noise.yaml"}), says);
  expectRefused(runSwiftlet({"papers", "--write", "/proc/papers.md"}), says);
}

}  // namespace
}  // namespace swiftlet::commands
