// scripts/setup on other machines: each is a folder of programs that answer as on that machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Setup : public testing::Test {
 protected:
  void SetUp() override {
    bin_ = fs::temp_directory_path() / ("swiftlet_setup_" + std::to_string(getpid()));
    fs::create_directories(bin_);
    for (const std::string tool :
         {"bash", "sed", "awk", "grep", "wc", "dirname", "mktemp", "rm", "sort", "head", "tail", "env", "cat"})
      fs::create_symlink("/usr/bin/" + tool, bin_ / tool);
    program("id", "echo 1000");
    program("apt-get", "echo \"$@\" >> " + (bin_ / "calls").string());
    program("dpkg-query", "exit 1");
  }
  void TearDown() override { fs::remove_all(bin_); }

  void program(const std::string& name, const std::string& body) {
    std::ofstream(bin_ / name) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(bin_ / name, fs::perms::owner_all);
  }
  Answer setup(const std::string& options) { return run("PATH=" + bin_.string() + " bash scripts/setup " + options); }
  std::string calls() {
    std::ifstream stream(bin_ / "calls");
    return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }

  fs::path bin_;
};

TEST_F(Setup, CheckListsMissingPackagesAndInstallsNothing) {
  const Answer answer = setup("--check");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr("Missing packages: g++ cmake"));
  EXPECT_EQ(calls(), "");
}

TEST_F(Setup, NoInstallContinuesWithMissingPackages) {
  const Answer answer = setup("--no-install");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.text, HasSubstr("Missing packages, left alone: g++"));
  EXPECT_EQ(calls(), "");
}

TEST_F(Setup, DoesNothingWhenEverythingIsInstalled) {
  program("dpkg-query", "shift 3; for package in \"$@\"; do echo installed $package; done");
  const Answer answer = setup("--tests --tools");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.text, "");
  EXPECT_EQ(calls(), "");
}

TEST_F(Setup, APackageThatWasRemovedButNotPurgedIsMissing) {
  program("dpkg-query", "shift 3; for package in \"$@\"; do echo config-files $package; done");
  EXPECT_THAT(setup("--check").text, HasSubstr("Missing packages: g++ cmake"));
}

TEST_F(Setup, AProgramFromAnotherSourceCountsAsInstalled) {
  EXPECT_THAT(setup("--tests --check").text, HasSubstr(" npm"));
  program("npm", "");
  EXPECT_THAT(setup("--tests --check").text, Not(HasSubstr(" npm")));
}

TEST_F(Setup, PrintsTheCommandWithoutRootAndSudo) {
  const Answer answer = setup("");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr("needs root or sudo"));
  EXPECT_THAT(answer.text, HasSubstr("apt-get install --no-install-recommends g++ cmake"));
  EXPECT_EQ(calls(), "");
}

TEST_F(Setup, UsesSudoWhenNotRoot) {
  program("sudo", "echo sudo >> " + (bin_ / "calls").string() + "; exec \"$@\"");
  EXPECT_EQ(setup("").exit_code, 0);
  EXPECT_THAT(calls(), HasSubstr("sudo\n-qq -o DPkg::Lock::Timeout=120 install -y --no-install-recommends g++ cmake"));
}

TEST_F(Setup, RootNeedsNoSudo) {
  program("id", "echo 0");
  program("sudo", "echo sudo >> " + (bin_ / "calls").string());
  EXPECT_EQ(setup("").exit_code, 0);
  EXPECT_THAT(calls(), HasSubstr("install -y --no-install-recommends g++ cmake"));
  EXPECT_THAT(calls(), Not(HasSubstr("sudo")));
}

struct Failure {
  const char* name;
  std::string apt_says;
  std::string setup_says;
};
class SetupFailure : public Setup, public testing::WithParamInterface<Failure> {};

TEST_P(SetupFailure, NamesItsCause) {
  program("id", "echo 0");
  program("apt-get", "case \"$*\" in *install*) echo \"" + GetParam().apt_says + "\"; exit 100;; esac");
  const Answer answer = setup("");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr(GetParam().setup_says));
  EXPECT_THAT(answer.text, HasSubstr(GetParam().apt_says)) << "apt's own words are shown too";
}

INSTANTIATE_TEST_SUITE_P(
    Causes, SetupFailure,
    testing::Values(
        Failure{"NoNetwork", "Err:1 http://deb.debian.org bookworm: Temporary failure resolving", "is there a network"},
        Failure{"UnknownPackage", "E: Unable to locate package libsdformat-dev", "built for Debian 12"},
        Failure{"FullDisk", "E: You don't have enough free space in /var/cache/apt/archives/.", "the disk is full"},
        Failure{"Another", "E: Sub-process /usr/bin/dpkg returned an error code (1)", "See for yourself: apt-get"}),
    [](const testing::TestParamInfo<Failure>& failure) { return failure.param.name; });

TEST_F(Setup, OnAnotherSystemItListsThePackages) {
  fs::remove(bin_ / "apt-get");
  const Answer answer = setup("");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr("not a Debian system"));
  EXPECT_THAT(answer.text, HasSubstr("g++ cmake"));
}

}  // namespace
}  // namespace swiftlet::repository
