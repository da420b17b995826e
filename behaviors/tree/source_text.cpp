#include "behaviors/tree/source_text.hpp"

#include <algorithm>

#include "behaviors/tree/utf8.hpp"

namespace swiftlet::tree {
namespace {

constexpr std::string_view kTagBlanks = " \t\r\n";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool endsLine(std::string_view text, std::size_t at) {
  return text[at] == '\n' || (text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n'));
}

}  // namespace

std::vector<SourceText::Mark> SourceText::marked() const {
  constexpr std::size_t kFarthest = 1024;  // Files of one line exist.
  Mark now{text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0};
  std::vector<Mark> marks = {now};
  for (; now.offset < text_.size(); ++now.offset) {
    if (now.offset - marks.back().offset >= kFarthest) marks.push_back(now);
    now.column += continuesCharacter(text_[now.offset]) ? 0 : 1;
    if (!endsLine(text_, now.offset)) continue;
    ++now.line;
    now.column = 1;
    marks.push_back({now.offset + 1, now.line, 1});
  }
  return marks;
}

Location SourceText::locate(std::size_t offset) const {
  if (marks_.empty()) marks_ = marked();
  const auto after = std::upper_bound(marks_.begin() + 1, marks_.end(), offset,
                                      [](std::size_t wanted, const Mark& mark) { return wanted < mark.offset; });
  const Mark& mark = *std::prev(after);
  const std::size_t begin = std::min(mark.offset, text_.size()), end = std::clamp(offset, begin, text_.size());
  const auto byteAt = [this](std::size_t at) { return text_.begin() + static_cast<std::ptrdiff_t>(at); };
  const auto characters = std::count_if(byteAt(begin), byteAt(end), [](char c) { return !continuesCharacter(c); });
  return {file_, mark.line, mark.column + static_cast<int>(characters)};
}

Location SourceText::locate(std::size_t element_offset, std::string_view attribute) const {
  const auto span = spanOf(element_offset, attribute);
  return locate(span ? span->name : element_offset);
}

std::optional<AttributeSpan> SourceText::spanOf(std::size_t element_offset, std::string_view attribute) const {
  for (auto span = nextSpan(endOfTagName(element_offset)); span; span = nextSpan(span->closing_quote + 1))
    if (std::string_view(text_).substr(span->name, span->name_end - span->name) == attribute) return span;
  return std::nullopt;
}

std::vector<AttributeSpan> SourceText::spansOf(std::size_t element_offset) const {
  std::vector<AttributeSpan> spans;
  for (auto span = nextSpan(endOfTagName(element_offset)); span; span = nextSpan(span->closing_quote + 1))
    spans.push_back(*span);
  return spans;
}

std::size_t SourceText::endOfTagName(std::size_t element_offset) const {
  return text_.find_first_of(" \t\r\n/>", element_offset);
}

/// The tag was read by expat, so it is well-formed: <name blanks name blanks = blanks quote ... quote ...
std::optional<AttributeSpan> SourceText::nextSpan(std::size_t from) const {
  const std::size_t at = text_.find_first_not_of(kTagBlanks, from);
  if (at == std::string::npos || text_[at] == '>' || text_[at] == '/') return std::nullopt;
  AttributeSpan span{.name = at};
  span.name_end = text_.find_first_of(" \t\r\n=", at);
  if (span.name_end == std::string::npos) return std::nullopt;
  span.opening_quote = text_.find_first_of("\"'", span.name_end);
  if (span.opening_quote == std::string::npos) return std::nullopt;
  span.closing_quote = text_.find(text_[span.opening_quote], span.opening_quote + 1);
  return span.closing_quote == std::string::npos ? std::nullopt : std::optional(span);
}

std::size_t SourceText::endOfTag(std::size_t tag_offset) const {
  char quote = '\0';
  for (std::size_t at = tag_offset; at < text_.size(); ++at) {
    const char c = text_[at];
    if (quote != '\0')
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      return at + 1;
  }
  return text_.size();
}

}  // namespace swiftlet::tree
