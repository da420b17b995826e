// A text whose attribute values hold `<` and `&` as themselves, made XML. XML does not allow them there, but tinyxml2,
// by which BehaviorTree.CPP reads, takes a value up to its closing quote.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::tree {

class EscapedText {
 public:
  /// Escapes each `<` in a value, and each `&` that begins neither one of the five entities nor `&#`.
  explicit EscapedText(std::string_view original);

  const std::string& text() const { return text_; }
  /// Where the byte at an offset of text() stands in the original.
  std::size_t originalOffset(std::size_t offset) const;
  /// Offsets in the original of what was escaped: the first of each value.
  const std::vector<std::size_t>& found() const { return found_; }

 private:
  /// From `offset` of text() on, it stands `by` bytes behind its place in the original.
  struct Shift {
    std::size_t offset = 0, by = 0;
  };

  char take();
  bool takeThrough(std::string_view begin, std::string_view end);
  void takeTag();
  void takeValue(char quote);

  std::string_view original_;
  std::size_t at_ = 0;  ///< In the original.
  std::string text_;
  std::vector<Shift> shifts_;
  std::vector<std::size_t> found_;
};

}  // namespace swiftlet::tree
