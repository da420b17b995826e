// Reading whole files: anything that is not a file is refused and never waited for.
#include "common/read_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "common/error.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::common {
namespace {

namespace fs = std::filesystem;
using test_support::HasProblem;
using test_support::problemsOf;
using testing::IsEmpty;

class ReadBytes : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::vector<Problem> problemOf(const fs::path& file, std::size_t most_bytes = 1000) {
    return problemsOf([&] { readBytes(file, most_bytes); });
  }
  fs::path folder_ = fs::temp_directory_path() / ("swiftlet-read-bytes-" + std::to_string(::getpid()));
};

TEST_F(ReadBytes, KnowsThePointersThatStandForFilesInAClone) {
  const auto problem = [&](const std::string& bytes) {
    std::ofstream(folder_ / "f", std::ios::binary) << bytes;
    return problemOf(folder_ / "f");
  };
  const std::string lfs = "version https://git-lfs.github.com/spec/v1";
  EXPECT_THAT(problem(lfs + "\noid sha256:83d7\nsize 234686\n"), HasProblem("file.pointer", "f", "`git lfs pull`"));
  EXPECT_THAT(problem(lfs + "\r\noid sha256:83d7\r\nsize 234686\r\n"), HasProblem("file.pointer", "f", "Git LFS"));
  EXPECT_THAT(problem("version https://git-lfs.github.com/spec/v2\n"), HasProblem("file.pointer", "f", "Git LFS"));
  EXPECT_THAT(problem("\xef\xbb\xbf" + lfs + "\n"), HasProblem("file.pointer", "f", "Git LFS"));
  EXPECT_THAT(problem("\xef\xbb\xbf/annex/objects/K\n"), HasProblem("file.pointer", "f", "git-annex"));
  EXPECT_THAT(problem("/annex/objects/SHA256E-s234686--83d7.pcd\n"),
              HasProblem("file.pointer", "f", "`git annex get`"));
  for (const std::string link : {".git/annex/objects/Zx/9q/K/K", "../../.git/annex/objects/Zx/9q/K/K",
                                 "../.git/modules/maps/annex/objects/Zx/9q/K/K\n"})
    EXPECT_THAT(problem(link), HasProblem("file.pointer", "f", "`git annex get`"));
  EXPECT_THAT(problem("see .git/annex/objects/Zx"), IsEmpty());
  EXPECT_THAT(problem("version 1\n"), IsEmpty());
  EXPECT_THAT(problem("see " + lfs), IsEmpty());
}

TEST_F(ReadBytes, APackedFileIsNoText) {
  const auto problem = [&](const std::string& bytes) {
    std::ofstream(folder_ / "f", std::ios::binary) << bytes;
    return problemsOf([&] { readText(folder_ / "f"); });
  };
  EXPECT_THAT(problem("\x1f\x8b\x08 and more"), HasProblem("file.packed", "f", "`gunzip`"));
  for (const char* bzip2 : {"BZh91AY", "BZh11AY"}) EXPECT_THAT(problem(bzip2), HasProblem("file.packed", "f", "bzip2"));
  EXPECT_THAT(problem("\xfd"
                      "7zXZ"),
              HasProblem("file.packed", "f", "xz"));
  EXPECT_THAT(problem("PK\x03\x04"), HasProblem("file.packed", "f", "zip"));
  EXPECT_THAT(problem("image: map.pgm\n"), IsEmpty());
  EXPECT_THAT(problem(""), IsEmpty());
}

TEST_F(ReadBytes, SaysWhereALinkLeadsThatLeadsToNothing) {
  fs::create_symlink("../.git/annex/objects/Zx/9q/K/K.bag", folder_ / "annexed");
  fs::create_symlink("elsewhere", folder_ / "dangling");
  EXPECT_THAT(problemOf(folder_ / "annexed"),
              HasProblem("file.broken-link", "annexed", "`../.git/annex/objects/Zx/9q/K/K.bag`, run `git annex get`"));
  EXPECT_THAT(problemOf(folder_ / "dangling"), HasProblem("file.broken-link", "dangling", "`elsewhere`"));
  std::ofstream(folder_ / "elsewhere") << "x";
  EXPECT_THAT(problemOf(folder_ / "dangling"), IsEmpty());
}

TEST_F(ReadBytes, ReturnsEveryByte) {
  const std::string bytes("a\0\r\n\xff", 5);
  std::ofstream(folder_ / "f", std::ios::binary) << bytes;
  EXPECT_EQ(readBytes(folder_ / "f"), bytes);
  EXPECT_EQ(readBytes(folder_ / "f", 5), bytes);
  EXPECT_THAT(problemOf(folder_ / "f", 4), HasProblem("file.too-large", "f", "4 bytes"));
}

TEST_F(ReadBytes, RefusesAnythingButFiles) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(problemOf(folder_ / "pipe"), HasProblem("file.is-pipe", "pipe"));
  EXPECT_THAT(problemOf("/dev/zero"), HasProblem("file.is-pipe", "/dev/zero"));
  EXPECT_THAT(problemOf(folder_), HasProblem("file.is-folder"));
  EXPECT_THAT(problemOf(folder_ / "none"), HasProblem("file.not-opened", "none", "No such file"));
  EXPECT_THAT(problemOf(folder_ / std::string(300, 'x')), HasProblem("file.not-opened", "", "File name too long"));
}

TEST_F(ReadBytes, KeepsToTheLimitWhenTheReportedSizeIsWrong) {
  EXPECT_THAT(problemOf("/proc/self/maps", 100), HasProblem("file.too-large", "", "100 bytes"));
}

}  // namespace
}  // namespace swiftlet::common
