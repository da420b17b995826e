// A terminal obeys control characters. Inputs (missions, logs, maps, worlds, names, arguments) may contain some; none
// of them reaches the terminal unescaped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/commands/missions.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

const std::string kEsc = "\x1b[31m";

bool isPrintable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
  });
}

class Printable : public test_support::Scratch {
 protected:
  /// Expects a refusal whose message shows the input with its control characters escaped.
  void refused(const std::vector<std::string>& arguments, const std::string& shown) const {
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_TRUE(isPrintable(end.err + end.out)) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(shown));
  }
};

TEST_F(Printable, ControlCharactersInArgumentsAreEscaped) {
  refused({kEsc + "fly"}, "`\\x1b[31mfly` is not a command");
  refused({"map", "a.log", "--json" + kEsc}, "`--json\\x1b[31m` is not an option");
  refused({"map", "a.log", "--odometry", kEsc}, "\\x1b[31m");
  refused({"map", path("a" + kEsc + ".log")}, "a\\x1b[31m.log: cannot be opened");
  refused({"fly", "missions/explore_and_return.xml", "--headless", "--system", kEsc}, "\\x1b[31m");
}

TEST_F(Printable, ControlCharactersInAMissionAreEscaped) {
  // XML forbids ESC itself, but allows the control characters of Latin-1, which terminals of eight bits obey.
  refused({"check", write("esc.xml", missionWith("<Fly" + kEsc + "/>"))}, "esc.xml:");
  refused({"check", write("c1.xml", missionWith("<TakeOff height_m=\"\xc2\x9b"
                                                "31m\"/>"))},
          "\\xc2\\x9b31m");
}

TEST_F(Printable, ControlCharactersInALogAreEscaped) {
  const std::string log = write("b" + kEsc + ".log", "# message\nFLASER 1 " + kEsc + " 0 0 0 0 0 0 1 h 1\n");
  refused({"map", log, "--out", path("out")}, "b\\x1b[31m.log");
}

TEST_F(Printable, ControlCharactersInAMapAreEscaped) {
  const std::string map = write("map.yaml",
                                "image: \"\\e[31m.pgm\"\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  refused({"localize", map, "a.log"}, "\\x1b[31m.pgm");
}

TEST_F(Printable, ControlCharactersInAWorldAreEscaped) {
  refused({"fly", "missions/explore_and_return.xml", "--headless", "--world",
           write("w.sdf",
                 "<sdf version=\"1.9\"><world name=\"\xc2\x9b\"><model name=\"\xc2\x9b\"><link name=\"l\">"
                 "<collision name=\"c\"><geometry><box><size>\xc2\x9b</size></box></geometry></collision>"
                 "</link></model></world></sdf>")},
          "w.sdf");
}

TEST_F(Printable, JsonStaysValid) {
  const ProgramEnd end = runSwiftlet({"check", path("no\x7f\xc2\x9bsuch.xml"), "--json"});
  EXPECT_TRUE(isPrintable(end.out)) << describe(end);
  EXPECT_EQ(end.out.find('\x9b'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(end.out).at("problems").at(0).at("file"), path("no\x7f\xc2\x9bsuch.xml"));
}

}  // namespace
}  // namespace swiftlet::commands
