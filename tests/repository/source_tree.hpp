// The repository's own files, for the tests in this folder.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace swiftlet::repository {

/// Text of each file by its path from the root, sorted.
using Files = std::map<std::string, std::string>;

/// Every file that is tracked or would be (not ignored), except binary files.
const Files& trackedFiles();

/// What a program prints on both streams, and its exit code. `command` is read by the shell, in the root.
struct Answer {
  int exit_code = 0;
  std::string text;
};
Answer run(const std::string& command);

std::vector<std::string> linesOf(const std::string& text);
bool endsWithAny(const std::string& path, const std::vector<std::string>& endings);
/// "a/b" of "a/b/c.hpp"; empty for a file in the root.
std::string folderOf(const std::string& path);
/// "a" of "a/b/c.hpp".
std::string topFolderOf(const std::string& path);

/// For messages of failed checks.
std::string joined(const std::vector<std::string>& lines);

/// `#include "..."` of our own.
struct Include {
  std::string file;
  int line = 0;
  std::string target;
};
std::vector<Include> includesOf(const std::string& path, const std::string& text);

/// Each folder with the folders it may use, read from the table of docs/architecture.md, so that the page cannot be
/// wrong.
using Arrows = std::map<std::string, std::set<std::string>>;
Arrows readArrows(const std::string& page);

/// The row of the table that holds the file: the deepest folder above it that has one. Empty: none has.
std::string ownerOf(const std::string& path, const Arrows& arrows);

/// "file:line: folder may not use folder" for every include that is not in the list.
std::vector<std::string> forbiddenArrows(const Files& files, const Arrows& arrows);

/// One line a cycle, "a -> b -> a".
std::vector<std::string> cycles(const Arrows& graph);
/// Which file includes which.
Arrows fileGraph(const Files& files);

/// A header and its source count as one part. One line for two parts that include each other: "a/one <-> a/two".
std::vector<std::string> twoWayPairs(const Files& files);

}  // namespace swiftlet::repository
