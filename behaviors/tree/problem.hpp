// A problem in a tree file, as shown to the user.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/message.hpp"

namespace swiftlet::tree {

/// Lines and columns count from 1, columns in characters; 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  bool operator==(const Location&) const = default;
};

struct Problem {
  Location location;
  std::string element;  ///< The tag, or "Tag.port".
  Message message;      ///< What is wrong, with the offending text, and what was expected.
  std::string hint{};   ///< "did you mean `x`?"; may be empty.
  std::string path{};   ///< "Main/Sequence[2]/Land", the node in its tree; empty if it is about no node.

  bool operator==(const Problem&) const = default;
};

/// "file:line:column" without the parts that are unknown.
std::string toString(const Location& location);
/// "file:line:column: element: message, hint".
std::string toString(const Problem& problem);
/// One line a problem.
std::string toString(const std::vector<Problem>& problems);

/// "did you mean `x`?" for the candidate nearest to `word` by edit distance, else for the shortest that begins with it,
/// or an empty string without one. A name that differs only in its unit (`clearance_cm`, `clearance`) counts as
/// nearest.
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);
/// "`red`, `blue`".
std::string quotedList(std::span<const std::string> words);

}  // namespace swiftlet::tree
