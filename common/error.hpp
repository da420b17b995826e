// Errors in input that is read at start (configuration, mission, world, map): one exception type with place and cause.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/message.hpp"

namespace swiftlet::common {

/// A place in a file. Lines and columns count from 1; 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column" without the parts that are unknown.
std::string toString(const SourceLocation& location);

/// One problem of an input file, as it is shown to the user.
struct Problem {
  SourceLocation location;
  std::string element;  ///< The key, tag or field it is about; may be empty.
  Message message;      ///< What is wrong and what was expected, with the text that caused it.
  std::string hint;     ///< "did you mean `x`?"; may be empty.
};

/// "file:line:column: element: message, hint".
std::string toString(const Problem& problem);
/// All of that as the message of another problem.
Message messageOf(const Problem& problem);

/// Thrown for input that cannot be used; carries every problem found, not only the first.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Problem problem);
  InputError(SourceLocation location, std::string element, Message message, std::string hint = "");
  explicit InputError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// The candidate nearest to `word` by edit distance, if it is near enough to be a likely correction.
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates);

/// "did you mean `x`?" or an empty string.
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace swiftlet::common
