// Lines of plain and compressed files: the same lines, with their numbers, in bounded memory.
#include "interfaces/files/line_reader.hpp"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include "support.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> linesOf(LineReader reader) {
  std::vector<std::string> lines;
  for (std::string_view line; reader.next(line);) {
    lines.emplace_back(line);
    EXPECT_EQ(reader.lineNumber(), static_cast<int>(lines.size()));
  }
  std::string_view more;
  EXPECT_FALSE(reader.next(more)) << "the end stays the end";
  return lines;
}

std::vector<std::string> linesOfText(std::string_view text) { return linesOf(LineReader::fromBytes(text, "text")); }

/// Splits the text with a simple loop, for comparison.
std::vector<std::string> cutByHand(std::string text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (lines.back().ends_with('\r')) lines.back().pop_back();
    text.erase(0, end == std::string::npos ? text.size() : end + 1);
  }
  return lines;
}

/// Numbers that do not compress too well.
std::string longText() {
  std::string text;
  std::uint64_t state = 1;
  for (int i = 0; i < 50'000; ++i) text += std::to_string(state = state * 6364136223846793005ULL + 1) + "\n";
  return text;
}

TEST(LineReader, AcceptsUnixAndWindowsLineEndings) {
  EXPECT_THAT(linesOfText("one\ntwo\r\n\nlast"), ElementsAre("one", "two", "", "last"));
  EXPECT_THAT(linesOfText("one\n"), ElementsAre("one"));
  EXPECT_THAT(linesOfText("\n\n"), ElementsAre("", ""));
  EXPECT_THAT(linesOfText(""), ElementsAre());
}

RC_GTEST_PROP(LineReader, SplitsAnyTextLikeASimpleLoop, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::element('\n', '\r', 'a', '\0', '#'));
  RC_ASSERT(linesOfText(text) == cutByHand(text));
}

TEST(LineReader, CompressedFilesGiveTheSameLines) {
  const ScratchFolder folder;
  const std::string text = longText();
  put(folder / "plain", text);
  const auto expected = cutByHand(text);
  EXPECT_EQ(linesOf(LineReader(folder / "plain")), expected);
  for (const char* tool : {"gzip", "bzip2", "xz"}) {
    const fs::path packed = folder / (std::string(tool) + ".any-name");
    if (!outputOf(std::string(tool) + " -c " + (folder / "plain").string() + " > " + packed.string()))
      GTEST_SKIP() << "NOT TESTED: there is no " << tool;
    EXPECT_EQ(linesOf(LineReader(packed)), expected) << tool;
  }
}

/// In UTF-16 with its byte order mark.
std::string utf16(const std::u16string& text, bool big_endian) {
  std::string bytes;
  for (const char16_t unit : u'\ufeff' + text) {
    const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
    bytes += big_endian ? std::string{high, low} : std::string{low, high};
  }
  return bytes;
}

TEST(LineReader, TextsInUtf16GiveTheSameLines) {
  std::u16string numbers;
  for (const char letter : longText().substr(0, 50'000)) numbers += static_cast<char16_t>(letter);
  for (const bool big_endian : {false, true}) {
    EXPECT_THAT(linesOfText(utf16(u"1.5 2\r\n\u00e9 \u20ac \U0001f681\n", big_endian)),
                ElementsAre("1.5 2", "\u00e9 \u20ac \U0001f681"));
    EXPECT_EQ(linesOfText(utf16(numbers, big_endian)), cutByHand(longText().substr(0, 50'000)));
    EXPECT_THAT(linesOfText(utf16(u"a\xd83d"
                                  u"b\xde81",
                                  big_endian)),
                ElementsAre("a\ufffdb\ufffd"))
        << "halves of pairs";
    EXPECT_THAT(linesOfText(utf16(u"a", big_endian) + "b"), ElementsAre("a\ufffd")) << "half of a unit";
    EXPECT_THAT(linesOfText(utf16(u"", big_endian)), ElementsAre());
  }
}

TEST(LineReader, ACompressedPointerOfGitLfsIsKnownAsOne) {
  const ScratchFolder folder;
  put(folder / "p", "\xef\xbb\xbfversion https://git-lfs.github.com/spec/v1\noid sha256:83d7\nsize 9\n");
  for (const char* tool : {"gzip", "bzip2", "xz"}) {
    const fs::path packed = folder / (std::string("p.") + tool);
    if (!outputOf(std::string(tool) + " -c " + (folder / "p").string() + " > " + packed.string())) continue;
    EXPECT_THAT(problemsOf([&] { UnpackedStream{packed}; }), HasProblem("file.pointer", "", "`git lfs pull`")) << tool;
  }
}

/// Reads to the end or to a problem, which it returns; `lines` counts those that were returned before.
std::vector<common::Problem> readUntilProblem(const fs::path& file, int& lines) {
  lines = 0;
  return problemsOf([&] {
    LineReader reader(file);
    for (std::string_view line; reader.next(line);) lines = reader.lineNumber();
  });
}

TEST(LineReader, ReportsTruncatedAndDamagedFiles) {
  const ScratchFolder folder;
  put(folder / "plain", longText());
  int lines = 0;
  for (const char* tool : {"gzip", "bzip2", "xz"}) {
    const auto packed = outputOf(std::string(tool) + " -c " + (folder / "plain").string());
    if (!packed) GTEST_SKIP() << "NOT TESTED: there is no " << tool;
    for (const std::size_t missing : {std::size_t{1}, packed->size() / 4, packed->size() - 20}) {
      put(folder / "cut", packed->substr(0, packed->size() - missing));
      EXPECT_THAT(readUntilProblem(folder / "cut", lines), HasProblem("file.damaged"))
          << tool << " without its last " << missing << " bytes";
    }
    std::string damaged = *packed;
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
    put(folder / "damaged", damaged);
    EXPECT_THAT(readUntilProblem(folder / "damaged", lines), HasProblem("file.damaged")) << tool;
  }
}

/// A gzip file of one stored block: it can still be decoded when any byte of its content changes.
std::string storedByGzip(const std::string& text) {
  struct Byte {
    std::size_t value;
    char operator()(int index) const { return static_cast<char>(value >> (8 * index) & 0xff); }
  };
  const Byte size{text.size()}, other{~text.size()},
      crc{crc32(0, reinterpret_cast<const Bytef*>(text.data()), text.size())};
  std::string packed("\x1f\x8b\x08\0\0\0\0\0\0\x03\x01", 11);
  for (const Byte& word : {size, other}) packed += {word(0), word(1)};
  packed += text;
  for (const Byte& word : {crc, size}) packed += {word(0), word(1), word(2), word(3)};
  return packed;
}

TEST(LineReader, ChecksChecksumAndLengthOfGzip) {
  const ScratchFolder folder;
  const std::string packed = storedByGzip("the first line\nthe second line\n");
  int lines = 0;
  put(folder / "x", packed);
  EXPECT_THAT(readUntilProblem(folder / "x", lines), IsEmpty());
  EXPECT_EQ(lines, 2);
  for (const auto& [back, why] :
       {std::pair{16, "data check"}, {10, "data check"}, {8, "data check"}, {1, "length check"}}) {
    std::string damaged = packed;
    damaged[damaged.size() - back] ^= 1;
    put(folder / "x", damaged);
    EXPECT_THAT(readUntilProblem(folder / "x", lines), HasProblem("file.damaged", "x:2", why));
    EXPECT_EQ(lines, 2) << "what came before the checksum is given";
  }
}

TEST(LineReader, ReadsSeveralGzipMembersAndAllowsOnlyZerosAfterThem) {
  const ScratchFolder folder;
  const std::string one = storedByGzip("the first line\n"), two = storedByGzip("the second line\n"), zeros(600, '\0');
  put(folder / "x", one + two + zeros);
  EXPECT_THAT(linesOf(LineReader(folder / "x")), ElementsAre("the first line", "the second line"));
  put(folder / "x", storedByGzip(one + two));
  EXPECT_THAT(linesOf(LineReader(folder / "x")), ElementsAre("the first line", "the second line")) << "packed twice";
  for (const std::string& behind : {std::string("trash"), zeros + two, std::string(1, '\x1f')}) {
    put(folder / "x", one + behind);
    int lines = 0;
    EXPECT_THAT(readUntilProblem(folder / "x", lines), HasProblem("file.damaged", "x:1"));
  }
  std::string layers = "end\n";
  for (int i = 0; i < 30; ++i) layers = storedByGzip(layers);
  put(folder / "x", layers);
  int lines = 0;
  EXPECT_THAT(readUntilProblem(folder / "x", lines), HasProblem("file.damaged"));
}

TEST(LineReader, ReportsDataAfterBzip2) {
  const ScratchFolder folder;
  put(folder / "plain", "one\ntwo\n");
  const auto packed = outputOf("bzip2 -c " + (folder / "plain").string());
  if (!packed) GTEST_SKIP() << "NOT TESTED: there is no bzip2";
  put(folder / "x", *packed + *packed);
  EXPECT_THAT(linesOf(LineReader(folder / "x")), ElementsAre("one", "two", "one", "two"));
  put(folder / "x", *packed + std::string(500, 't'));
  int lines = 0;
  EXPECT_THAT(readUntilProblem(folder / "x", lines), HasProblem("file.damaged", "x:2"));
  EXPECT_EQ(lines, 2);
}

TEST(LineReader, SkipsAByteOrderMark) {
  EXPECT_THAT(linesOfText("\xef\xbb\xbf"
                          "one\n\xef\xbb\xbf"
                          "two"),
              ElementsAre("one",
                          "\xef\xbb\xbf"
                          "two"));
  EXPECT_THAT(linesOfText("\xef\xbb\xbf"), ElementsAre(""));
  EXPECT_THAT(linesOfText("\xef\xbb"), ElementsAre("\xef\xbb"));
}

TEST(LineReader, ReturnsTheLinesBeforeATruncation) {
  const ScratchFolder folder;
  put(folder / "plain", longText());
  const auto packed = outputOf("gzip -c " + (folder / "plain").string());
  if (!packed) GTEST_SKIP() << "NOT TESTED: there is no gzip";
  put(folder / "cut", packed->substr(0, packed->size() - packed->size() / 4));
  int lines = 0;
  const auto problems = readUntilProblem(folder / "cut", lines);
  EXPECT_THAT(problems, HasProblem("file.damaged", "cut:" + std::to_string(lines)));
  EXPECT_GT(lines, 30'000);
}

TEST(LineReader, RefusesLongLinesAndLongFiles) {
  const std::string text = "short\n" + std::string(100, 'x') + "\n" + std::string(101, 'y') + "\nnever";
  const auto read = [&](LineLimits limits) {
    return problemsOf([&] { linesOf(LineReader::fromBytes(text, "file", limits)); });
  };
  EXPECT_THAT(read({101}), IsEmpty());
  EXPECT_THAT(read({100}), HasProblem("text.line-too-long", "file:3"));
  EXPECT_THAT(read({1000, 64}), HasProblem("text.too-large"));
  std::string endless;
  endless.resize(10'000'000, 'z');
  EXPECT_THAT(problemsOf([&] { linesOf(LineReader::fromBytes(endless, "file")); }),
              HasProblem("text.line-too-long", "file:1"));
}

TEST(LineReader, RefusesAnythingButFiles) {
  const ScratchFolder folder;
  EXPECT_THAT(problemsOf([&] { LineReader reader(folder / "none"); }), HasProblem("file.not-opened", "none"));
  EXPECT_THAT(problemsOf([&] { LineReader reader(folder.path()); }), HasProblem("file.is-folder"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(problemsOf([&] { LineReader reader(folder / "pipe"); }), HasProblem("file.is-pipe"));
}

TEST(LineReader, ReportsThePlaceOfProblems) {
  LineReader reader = LineReader::fromBytes("a\nb c\n", "x.txt");
  std::string_view line;
  reader.next(line);
  reader.next(line);
  const common::InputError error = reader.problemAt(3, "word", common::Message("test.wrong", "is wrong"), "hint");
  EXPECT_STREQ(error.what(), "x.txt:2:3: word: is wrong, hint");
}

RC_GTEST_PROP(LineReader, TruncatesLongLinesInBoundedMemory, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::element('\n', 'a', 'b'));
  LineReader reader = LineReader::fromBytes(text, "text", {3, 1 << 20, true});
  std::size_t i = 0;
  const auto lines = cutByHand(text);
  for (std::string_view line; reader.next(line); ++i) {
    RC_ASSERT(i < lines.size());
    RC_ASSERT(line == lines[i].substr(0, 3));
    RC_ASSERT(reader.lineCut() == (lines[i].size() > 3));
  }
  RC_ASSERT(i == lines.size());
}

TEST(LineReader, TruncatesALineOfManyBlocks) {
  const std::string text = "one\n" + std::string(3'000'000, 'x') + "\ntwo\n" + std::string(500'000, 'y');
  LineReader reader = LineReader::fromBytes(text, "text", {100, 1 << 30, true});
  std::vector<std::size_t> sizes;
  for (std::string_view line; reader.next(line);) sizes.push_back(line.size());
  EXPECT_THAT(sizes, ElementsAre(3, 100, 3, 100));
  EXPECT_EQ(reader.lineNumber(), 4);
}

}  // namespace
}  // namespace swiftlet::interfaces
