// A text that tinyxml2, by which BehaviorTree.CPP reads, takes and XML does not allow, made XML: a comment with `--` in
// it, which tinyxml2 takes up to its `-->`, and a value with `<` and `&` as themselves, which it takes up to its quote.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::tree {

class EscapedText {
 public:
  /// Replaces each `-` in such a comment. With `values` it escapes each `<` in a value, and each `&` that begins
  /// neither one of the five entities nor `&#`.
  EscapedText(std::string_view original, bool values);

  const std::string& text() const { return text_; }
  /// Where the byte at an offset of text() stands in the original.
  std::size_t originalOffset(std::size_t offset) const;
  /// Offsets in the original of what XML does not allow: the first of each value, and the first `--` of each comment.
  const std::vector<std::size_t>& found() const { return found_; }

 private:
  /// From `offset` of text() on, it stands `by` bytes behind its place in the original.
  struct Shift {
    std::size_t offset = 0, by = 0;
  };

  char take();
  bool takeThrough(std::string_view begin, std::string_view end);
  bool takeComment();
  void takeTag();
  void takeValue(char quote);

  std::string_view original_;
  bool values_;
  std::size_t at_ = 0;  ///< In the original.
  std::string text_;
  std::vector<Shift> shifts_;
  std::vector<std::size_t> found_;
};

}  // namespace swiftlet::tree
