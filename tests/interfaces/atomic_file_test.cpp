// Files are either whole or unchanged.
#include "interfaces/files/atomic_file.hpp"

#include <csignal>

#include <gmock/gmock.h>

#include "support.hpp"

namespace swiftlet::interfaces {
namespace {

std::size_t entriesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

TEST(AtomicFile, ReplacesTheWholeContent) {
  const ScratchFolder folder;
  const std::string binary("a\0b\nc", 5);
  ASSERT_TRUE(writeAtomically(folder / "x", "the first and longer content"));
  ASSERT_TRUE(writeAtomically(folder / "x", binary, Durability::kPower));
  EXPECT_EQ(bytesOf(folder / "x"), binary);
  EXPECT_EQ(entriesIn(folder), 1u);
}

TEST(AtomicFile, ErrorsNameTheFileAndTheReason) {
  const ScratchFolder folder;
  const Written written = writeAtomically(folder / "missing" / "x", "bytes");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message.name(), "file.not-written");
  EXPECT_EQ(written.error().why, std::errc::no_such_file_or_directory);
}

TEST(AtomicFile, AFullDiskLeavesOnlyTheOldContent) {
  const ScratchFolder folder;
  ASSERT_TRUE(writeAtomically(folder / "x", "old"));
  EXPECT_TRUE(withFullDisk(1000, [&] { return !writeAtomically(folder / "x", std::string(5000, 'n')); }));
  EXPECT_EQ(bytesOf(folder / "x"), "old");
  EXPECT_EQ(entriesIn(folder), 1u);
}

TEST(AtomicFile, PiecesAreOneContent) {
  const ScratchFolder folder;
  const auto pieces = [](const WriteBytes& write) {
    for (const char piece : {'a', 'b', 'c'}) write(std::string(600, piece));
  };
  ASSERT_TRUE(writeAtomically(folder / "x", pieces));
  EXPECT_EQ(bytesOf(folder / "x"), std::string(600, 'a') + std::string(600, 'b') + std::string(600, 'c'));
  ASSERT_TRUE(writeAtomically(folder / "x", "old"));
  EXPECT_TRUE(withFullDisk(1000, [&] { return !writeAtomically(folder / "x", pieces); })) << "the second does not fit";
  EXPECT_EQ(bytesOf(folder / "x"), "old");
  EXPECT_EQ(entriesIn(folder), 1u);
}

TEST(AppendFile, GrowsByWholeRecords) {
  const ScratchFolder folder;
  auto file = AppendFile::create(folder / "x");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append("one\n"));
  EXPECT_EQ(bytesOf(folder / "x"), "one\n") << "a record must not wait in a buffer";
  AppendFile moved = std::move(*file);
  ASSERT_TRUE(moved.append("two\n"));
  EXPECT_EQ(bytesOf(folder / "x"), "one\ntwo\n");
}

TEST(AppendFile, AFullDiskRemovesThePartialRecord) {
  const ScratchFolder folder;
  EXPECT_TRUE(withFullDisk(1000, [&] {
    auto file = AppendFile::create(folder / "x");
    const bool first = file->append(std::string(900, 'a')).has_value();
    const bool second = file->append(std::string(200, 'b')).has_value();
    const bool third = file->append(std::string(100, 'c')).has_value();
    return first && !second && third;
  }));
  EXPECT_EQ(bytesOf(folder / "x"), std::string(900, 'a') + std::string(100, 'c'));
}

TEST(AppendFile, RefusesAFolder) {
  const ScratchFolder folder;
  const auto file = AppendFile::create(folder);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().why, std::errc::is_a_directory);
}

}  // namespace
}  // namespace swiftlet::interfaces
