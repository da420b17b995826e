// Archives are unpacked once, whole, and never outside their folder.
#include "interfaces/files/archive.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <gmock/gmock.h>

#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::problemsOf;
using testing::AnyOf;

struct Entry {
  std::string name;
  std::string content;
  unsigned type = AE_IFREG;
  std::string link = {};  // Few entries have one.
};

void writeTar(const fs::path& file, const std::vector<Entry>& entries) {
  struct archive* writer = archive_write_new();
  archive_write_set_format_pax_restricted(writer);
  archive_write_add_filter_xz(writer);
  ASSERT_EQ(archive_write_open_filename(writer, file.c_str()), ARCHIVE_OK);
  for (const Entry& e : entries) {
    struct archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, e.name.c_str());
    archive_entry_set_filetype(entry, e.type);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, static_cast<la_int64_t>(e.content.size()));
    if (e.type == AE_IFLNK) archive_entry_set_symlink(entry, e.link.c_str());
    if (e.type == AE_IFREG && !e.link.empty()) archive_entry_set_hardlink(entry, e.link.c_str());
    archive_write_header(writer, entry);
    archive_write_data(writer, e.content.data(), e.content.size());
    archive_entry_free(entry);
  }
  archive_write_close(writer);
  archive_write_free(writer);
}

TEST(Archive, UnpacksOnceIntoTheCache) {
  const ScratchFolder folder;
  writeTar(folder / "house.tar.xz", {{"./models", "", AE_IFDIR}, {"./models/a/model.sdf", "<sdf/>"}, {"top.txt", ""}});
  const fs::path unpacked = unpackInto(folder / "cache", folder / "house.tar.xz");
  EXPECT_EQ(unpacked.parent_path(), folder / "cache");
  EXPECT_THAT(unpacked.filename().string(), testing::StartsWith("house-"));
  EXPECT_EQ(bytesOf(unpacked / "models/a/model.sdf"), "<sdf/>");
  EXPECT_TRUE(fs::is_regular_file(unpacked / "top.txt"));

  put(unpacked / "witness", "still there");
  EXPECT_EQ(unpackInto(folder / "cache", folder / "house.tar.xz"), unpacked);
  EXPECT_TRUE(fs::exists(unpacked / "witness")) << "a second call must not unpack again";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "cache"), fs::directory_iterator{}), 1);
}

TEST(Archive, DifferentContentGetsADifferentFolder) {
  const ScratchFolder folder;
  writeTar(folder / "w.tar.xz", {{"a", "1"}});
  const fs::path first = unpackInto(folder / "cache", folder / "w.tar.xz");
  writeTar(folder / "w.tar.xz", {{"a", "2"}});
  const fs::path second = unpackInto(folder / "cache", folder / "w.tar.xz");
  EXPECT_NE(first, second);
  EXPECT_EQ(bytesOf(second / "a"), "2");
}

TEST(Archive, RefusesEntriesOutsideTheFolderAndLeavesNothing) {
  const ScratchFolder folder;
  const auto problem = [&](const Entry& bad) {
    writeTar(folder / "bad.tar.xz", {{"good", "content"}, bad});
    const auto problems = problemsOf([&] { unpackInto(folder / "cache", folder / "bad.tar.xz"); });
    EXPECT_TRUE(fs::is_empty(folder / "cache")) << bad.name;
    return problems;
  };
  EXPECT_THAT(problem({"../evil", "x"}), HasProblem("archive.leads-out", "bad.tar.xz: ../evil"));
  EXPECT_THAT(problem({"a/../../evil", "x"}), HasProblem("archive.leads-out"));
  EXPECT_THAT(problem({"/tmp/evil", "x"}), HasProblem("archive.not-relative", "/tmp/evil"));
  EXPECT_THAT(problem({"link", "", AE_IFLNK, "/etc"}), HasProblem("archive.no-file", "link"));
  EXPECT_THAT(problem({"hard", "", AE_IFREG, "/etc/passwd"}), HasProblem("archive.no-file", "hard"));
  EXPECT_THAT(problem({"pipe", "", AE_IFIFO}), HasProblem("archive.no-file", "pipe"));
  EXPECT_FALSE(fs::exists(folder / "evil"));
}

TEST(Archive, RefusesDamagedAndMissingArchives) {
  const ScratchFolder folder;
  writeTar(folder / "w.tar.xz", {{"a", std::string(100'000, 'q')}, {"b", "content"}});
  const std::string whole = bytesOf(folder / "w.tar.xz");
  put(folder / "cut.tar.xz", whole.substr(0, whole.size() / 2));
  put(folder / "text.tar.xz", "this is no archive at all, whatever it is called");
  put(folder / "empty.tar.xz", "");
  for (const char* name : {"cut.tar.xz", "text.tar.xz", "empty.tar.xz"}) {
    EXPECT_THAT(problemsOf([&] { unpackInto(folder / "cache", folder / name); }),
                AnyOf(HasProblem("archive.not-unpacked", name), HasProblem("archive.empty", name)));
    EXPECT_TRUE(!fs::exists(folder / "cache") || fs::is_empty(folder / "cache")) << name;
  }
  EXPECT_THAT(problemsOf([&] { unpackInto(folder / "cache", folder / "none.tar.xz"); }), HasProblem("file.not-opened"));
}

TEST(Archive, ReportsAnUnwritableCache) {
  const ScratchFolder folder;
  writeTar(folder / "w.tar.xz", {{"a", "1"}});
  put(folder / "file", "");
  EXPECT_THAT(problemsOf([&] { unpackInto(folder / "file", folder / "w.tar.xz"); }), HasProblem("folder.not-written"));
}

TEST(Archive, ReportsAFullDiskAndLeavesNothing) {
  const ScratchFolder folder;
  writeTar(folder / "w.tar.xz", {{"a", std::string(100'000, 'q')}});
  EXPECT_TRUE(withFullDisk(50'000, [&] {
    const auto problems = problemsOf([&] { unpackInto(folder / "cache", folder / "w.tar.xz"); });
    return problems.size() == 1 && problems[0].message.name() == "file.not-written";
  }));
  EXPECT_TRUE(fs::is_empty(folder / "cache"));
}

TEST(Archive, UnpacksTheWorldsOfTheDataSets) {
  const auto worlds = test_support::dataSet("06-sim-worlds");
  if (!worlds) return;
  const ScratchFolder folder;
  const fs::path house =
      unpackInto(folder / "cache", *worlds / "turtlebot3_house_and_world/turtlebot3_house_and_world.tar.xz");
  EXPECT_TRUE(fs::is_regular_file(house / "models/turtlebot3_house/model.sdf"));
  const fs::path cafe = unpackInto(folder / "cache", *worlds / "gz_cafe/gz_cafe.tar.xz");
  EXPECT_TRUE(fs::is_regular_file(cafe / "cafe/model.sdf"));
}

}  // namespace
}  // namespace swiftlet::interfaces
