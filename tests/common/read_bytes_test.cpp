// Reading whole files: anything that is not a file is refused and never waited for.
#include "common/read_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReadBytes : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string problemOf(const fs::path& file, std::size_t most_bytes = 1000) {
    try {
      readBytes(file, most_bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_ = fs::temp_directory_path() / ("swiftlet-read-bytes-" + std::to_string(::getpid()));
};

TEST_F(ReadBytes, KnowsThePointersThatStandForFilesInAClone) {
  const auto problem = [&](const std::string& bytes) {
    std::ofstream(folder_ / "f", std::ios::binary) << bytes;
    return problemOf(folder_ / "f");
  };
  const std::string lfs = "version https://git-lfs.github.com/spec/v1";
  EXPECT_THAT(problem(lfs + "\noid sha256:83d7\nsize 234686\n"),
              HasSubstr("f: this is a pointer of Git LFS, not the file, run `git lfs pull` in its repository"));
  EXPECT_THAT(problem(lfs + "\r\noid sha256:83d7\r\nsize 234686\r\n"), HasSubstr("a pointer of Git LFS"));
  EXPECT_THAT(problem("version https://git-lfs.github.com/spec/v2\n"), HasSubstr("a pointer of Git LFS"));
  EXPECT_THAT(problem("\xef\xbb\xbf" + lfs + "\n"), HasSubstr("a pointer of Git LFS"));
  EXPECT_THAT(problem("\xef\xbb\xbf/annex/objects/K\n"), HasSubstr("a pointer of git-annex"));
  EXPECT_THAT(problem("/annex/objects/SHA256E-s234686--83d7.pcd\n"),
              HasSubstr("f: this is a pointer of git-annex, not the file, run `git annex get`"));
  for (const std::string link : {".git/annex/objects/Zx/9q/K/K", "../../.git/annex/objects/Zx/9q/K/K",
                                 "../.git/modules/maps/annex/objects/Zx/9q/K/K\n"})
    EXPECT_THAT(problem(link), HasSubstr("f: this is a pointer of git-annex, not the file, run `git annex get`"));
  EXPECT_EQ(problem("see .git/annex/objects/Zx"), "");
  EXPECT_EQ(problem("version 1\n"), "");
  EXPECT_EQ(problem("see " + lfs), "");
}

TEST_F(ReadBytes, APackedFileIsNoText) {
  const auto problem = [&](const std::string& bytes) {
    std::ofstream(folder_ / "f", std::ios::binary) << bytes;
    try {
      readText(folder_ / "f");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(problem("\x1f\x8b\x08 and more"),
              HasSubstr("f: is packed by gzip, a text was expected, unpack it by `gunzip`"));
  for (const char* bzip2 : {"BZh91AY", "BZh11AY"}) EXPECT_THAT(problem(bzip2), HasSubstr("is packed by bzip2"));
  EXPECT_THAT(problem("\xfd"
                      "7zXZ"),
              HasSubstr("is packed by xz"));
  EXPECT_THAT(problem("PK\x03\x04"), HasSubstr("is packed by zip"));
  EXPECT_EQ(problem("image: map.pgm\n"), "");
  EXPECT_EQ(problem(""), "");
}

TEST_F(ReadBytes, SaysWhereALinkLeadsThatLeadsToNothing) {
  fs::create_symlink("../.git/annex/objects/Zx/9q/K/K.bag", folder_ / "annexed");
  fs::create_symlink("elsewhere", folder_ / "dangling");
  EXPECT_THAT(
      problemOf(folder_ / "annexed"),
      HasSubstr("annexed: is a link that leads to nothing: `../.git/annex/objects/Zx/9q/K/K.bag`, run `git annex "
                "get` for it in its repository"));
  EXPECT_THAT(problemOf(folder_ / "dangling"), testing::EndsWith("is a link that leads to nothing: `elsewhere`"));
  std::ofstream(folder_ / "elsewhere") << "x";
  EXPECT_EQ(problemOf(folder_ / "dangling"), "");
}

TEST_F(ReadBytes, ReturnsEveryByte) {
  const std::string bytes("a\0\r\n\xff", 5);
  std::ofstream(folder_ / "f", std::ios::binary) << bytes;
  EXPECT_EQ(readBytes(folder_ / "f"), bytes);
  EXPECT_EQ(readBytes(folder_ / "f", 5), bytes);
  EXPECT_THAT(problemOf(folder_ / "f", 4), HasSubstr("f: is larger than 4 bytes"));
}

TEST_F(ReadBytes, RefusesAnythingButFiles) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(problemOf(folder_ / "pipe"), HasSubstr("pipe: is a pipe or a device"));
  EXPECT_THAT(problemOf("/dev/zero"), HasSubstr("is a pipe or a device"));
  EXPECT_THAT(problemOf(folder_), HasSubstr("is a folder"));
  EXPECT_THAT(problemOf(folder_ / "none"), HasSubstr("none: cannot be opened: No such file"));
  EXPECT_THAT(problemOf(folder_ / std::string(300, 'x')), HasSubstr("cannot be opened: File name too long"));
}

TEST_F(ReadBytes, KeepsToTheLimitWhenTheReportedSizeIsWrong) {
  EXPECT_THAT(problemOf("/proc/self/maps", 100), HasSubstr("is larger than 100 bytes"));
}

}  // namespace
}  // namespace swiftlet::common
