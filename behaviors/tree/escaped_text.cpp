#include "behaviors/tree/escaped_text.hpp"

#include <algorithm>
#include <array>

namespace swiftlet::tree {
namespace {

bool beginsReference(std::string_view text) {
  constexpr std::array<std::string_view, 6> kReferences = {"&#", "&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
  return std::any_of(kReferences.begin(), kReferences.end(),
                     [&](std::string_view reference) { return text.starts_with(reference); });
}

}  // namespace

EscapedText::EscapedText(std::string_view original, bool values) : original_(original), values_(values) {
  text_.reserve(original.size());
  while (at_ < original_.size()) {
    if (takeComment() || takeThrough("<![CDATA[", "]]>") || takeThrough("<?", "?>")) continue;
    if (take() == '<') takeTag();
  }
  original_ = {};
}

std::size_t EscapedText::originalOffset(std::size_t offset) const {
  const auto after = std::upper_bound(shifts_.begin(), shifts_.end(), offset,
                                      [](std::size_t wanted, const Shift& shift) { return wanted < shift.offset; });
  return after == shifts_.begin() ? offset : offset - std::prev(after)->by;
}

char EscapedText::take() {
  text_ += original_[at_];
  return original_[at_++];
}

/// Takes a stretch that begins so here, up to its end or the text's end; false if it does not begin so.
bool EscapedText::takeThrough(std::string_view begin, std::string_view end) {
  if (!original_.substr(at_).starts_with(begin)) return false;
  const std::size_t last = original_.find(end, at_ + begin.size());
  const std::size_t behind = last == std::string_view::npos ? original_.size() : last + end.size();
  text_ += original_.substr(at_, behind - at_);
  at_ = behind;
  return true;
}

/// Between its marks a comment of XML has no `--`, and does not end with `-`. One without an end gets no end here,
/// so that the reader reports it.
bool EscapedText::takeComment() {
  constexpr std::string_view kOpen = "<!--", kClose = "-->";
  const std::size_t begin = at_ + kOpen.size();
  if (!takeThrough(kOpen, kClose)) return false;
  const bool closed = at_ >= begin + kClose.size() && original_.substr(0, at_).ends_with(kClose);
  const std::size_t behind = closed ? kClose.size() : 0;
  const std::string_view words = original_.substr(begin, at_ - behind - begin);
  const std::size_t dashes = std::min(words.find("--"), words.ends_with('-') ? words.size() - 1 : words.npos);
  if (dashes == words.npos) return true;
  const auto end = text_.end() - static_cast<std::ptrdiff_t>(behind);
  std::replace(end - static_cast<std::ptrdiff_t>(words.size()), end, '-', '=');
  if (closed) found_.push_back(begin + dashes);
  return true;
}

void EscapedText::takeTag() {
  while (at_ < original_.size()) {
    const char c = take();
    if (c == '>') return;
    if (c == '"' || c == '\'') takeValue(c);
  }
}

void EscapedText::takeValue(char quote) {
  bool first = true;
  while (at_ < original_.size()) {
    const char c = original_[at_];
    if (!values_ || (c != '<' && (c != '&' || beginsReference(original_.substr(at_))))) {
      if (take() == quote) return;
      continue;
    }
    if (first) found_.push_back(at_);
    first = false;
    text_ += c == '<' ? "&lt;" : "&amp;";
    ++at_;
    shifts_.push_back({text_.size(), text_.size() - at_});
  }
}

}  // namespace swiftlet::tree
