// --leaves: leaves of one's own in a shared object, as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/commands/missions.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::AllOf;
using testing::HasSubstr;

std::string library(const std::string& name) { return SWIFTLET_BINARY_DIR "/leaf_libraries/libleaves_" + name + ".so"; }
const std::string kSquareLibrary = library("square");
const std::string kMission = SWIFTLET_SOURCE_DIR "/examples/own_leaf/square.xml";

class LeafLibraries : public test_support::Scratch {};

TEST_F(LeafLibraries, AreKnownToTheCheckAndToEditors) {
  const ProgramEnd without = runSwiftlet({"check", kMission});
  EXPECT_EQ(without.exit_code, 2) << describe(without);
  EXPECT_THAT(without.err, HasSubstr("square.xml:9:9: Square: "));
  const ProgramEnd with = runSwiftlet({"check", kMission, "--leaves", kSquareLibrary});
  EXPECT_EQ(with.exit_code, 0) << describe(with);
  EXPECT_EQ(with.err, "");
  EXPECT_THAT(runSwiftlet({"nodes", "--leaves", kSquareLibrary, "Square"}).out,
              AllOf(HasSubstr("Square: Flies round a square"), HasSubstr("side_m: a number in metres from 0.3 to 10")));
  EXPECT_THAT(runSwiftlet({"nodes", "--leaves", kSquareLibrary, "--xml"}).out, HasSubstr("<Action ID=\"Square\">"));
  EXPECT_THAT(runSwiftlet({"nodes", "--leaves", kSquareLibrary, "--xsd"}).out,
              HasSubstr("<xs:element name=\"Square\">"));
  const ProgramEnd owners = runSwiftlet({"check", kMission, "--leaves", kSquareLibrary, "--mock-leaves"});
  EXPECT_THAT(owners.out, HasSubstr("1 of --leaves: Square\n")) << describe(owners);
}

TEST_F(LeafLibraries, AreCheckedAsTheLeavesOfSwiftlet) {
  const std::string early = write("early.xml", missionWith("      <Square/>\n      <TakeOff/>\n      <Land/>\n"));
  EXPECT_THAT(runSwiftlet({"check", early, "--leaves", kSquareLibrary}).err,
              HasSubstr("early.xml:4:7: Square: the vehicle stands on the floor here, expected a TakeOff before it"));
  const std::string near =
      write("near.xml", missionWith("      <TakeOff/>\n      <Square clearance_m=\"0\"/>\n      <Land/>\n"));
  EXPECT_THAT(runSwiftlet({"check", near, "--leaves", kSquareLibrary}).err,
              HasSubstr("near.xml:5:15: Square.clearance_m: 0 m cannot be flown with this system"));
  const std::string script = write("square.script", "Square: RUNNING x2, SUCCESS\n");
  const ProgramEnd dry = runSwiftlet({"check", kMission, "--leaves", kSquareLibrary, "--dry-run", script});
  EXPECT_THAT(dry.out, HasSubstr("Square: RUNNING -> SUCCESS")) << describe(dry);
}

TEST_F(LeafLibraries, Fly) {
  const ProgramEnd end = runSwiftlet({"fly", kMission, "--leaves", kSquareLibrary, "--headless", "--json",
                                      "--time-limit", "120", "--out", path("run")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(test_support::readText(path("run/events.jsonl")), HasSubstr("Square"));
}

TEST_F(LeafLibraries, AreRefusedWithTheReason) {
  const auto refusal = [](const std::string& file) {
    const ProgramEnd end = runSwiftlet({"nodes", "--leaves", file});
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    return end.err;
  };
  EXPECT_THAT(refusal("no.so"), HasSubstr("no.so: --leaves: no such file"));
  EXPECT_THAT(refusal(write("text.so", "leaves")), HasSubstr("text.so: --leaves: cannot be loaded: "));
  EXPECT_THAT(refusal(library("no_entry")), HasSubstr("--leaves: has no entry `swiftlet_leaves`"));
  EXPECT_THAT(refusal(library("other_release")),
              HasSubstr("--leaves: is built for Swiftlet 0.1.0 (g++ 11.3.0), and this is "));
  EXPECT_THAT(refusal(library("other_headers")), HasSubstr("--leaves: is built with other headers than this program"));
  EXPECT_THAT(refusal(library("no_leaf")), HasSubstr("swiftlet_leaves: adds no leaf"));
  EXPECT_THAT(refusal(library("throws")), HasSubstr("swiftlet_leaves: the eye is shut"));
  EXPECT_THAT(refusal(library("known_name")), HasSubstr("Land: there is a node of that name"));
  EXPECT_THAT(refusal(library("wrong_default")),
              HasSubstr("Wink: its port `times` has a default that it does not take"));
  EXPECT_THAT(refusal(library("other_number")),
              HasSubstr("Wink: its port `mode` has `fast` as number 1, which is 0 in scripts"));
  const ProgramEnd twice = runSwiftlet({"nodes", "--leaves", kSquareLibrary, "--leaves", kSquareLibrary});
  EXPECT_THAT(twice.err, HasSubstr("Square: there is a node of that name")) << describe(twice);
}

}  // namespace
}  // namespace swiftlet::commands
