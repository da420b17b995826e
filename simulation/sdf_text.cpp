#include "simulation/sdf_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/misleading.hpp"
#include "common/printable.hpp"
#include "common/text_parts.hpp"
#include "common/utf16.hpp"

namespace swiftlet::simulation {
namespace {

using common::Message;

constexpr std::string_view kSpace = " \t\r\n";

/// Whether every value of the attributes begins with a quote.
bool areQuoted(std::string_view attributes) {
  for (std::size_t at = 0; (at = attributes.find('=', at)) != std::string_view::npos; ++at) {
    const std::size_t quote = attributes.find_first_not_of(kSpace, at + 1);
    if (quote == std::string_view::npos || (attributes[quote] != '"' && attributes[quote] != '\'')) return false;
    at = std::min(attributes.find(attributes[quote], quote + 1), attributes.size());
  }
  return true;
}

/// What "&lt;", "&#60;" or "&#x3C;" stands for, without the `&` and the `;`; as it is written if it is none of these.
std::string meantBy(std::string_view entity) {
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kNamed{
      {{"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}, {"amp", "&"}}};
  for (const auto& [name, letter] : kNamed)
    if (entity == name) return letter;
  const std::string as_written = fmt::format("&{};", entity);
  if (!entity.starts_with('#')) return as_written;
  const bool hexadecimal = entity.starts_with("#x");
  const std::string_view digits = entity.substr(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
  constexpr std::uint32_t kMost = 0x10FFFF;
  if (error != std::errc() || end != digits.data() + digits.size() || code == 0 || code > kMost) return as_written;
  std::string letter;
  common::appendUtf8(letter, code);
  return letter;
}

std::string withoutEntities(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find('&'), text.size()), end = text.find(';', begin);
    plain += text.substr(0, begin);
    text.remove_prefix(begin);
    if (end == std::string_view::npos) return plain.append(text);
    if (!text.empty()) plain += meantBy(text.substr(1, end - begin - 1));
    text.remove_prefix(text.empty() ? 0 : end - begin + 1);
  }
  return plain;
}

/// Follows one text; the views that it gives are into it.
class TagReader {
 public:
  TagReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  tl::expected<std::vector<SdfTag>, common::Problem> read() {
    while (!problem_ && (at_ = text_.find('<', at_)) != std::string_view::npos) readMarkup();
    if (!problem_ && !open_.empty())
      fail(tags_[open_.back()].begin,
           Message("xml.not-closed", "malformed XML: <{}> is not closed", tags_[open_.back()].name));
    if (!problem_ && tags_.empty()) fail(text_.size(), Message("xml.no-element", "malformed XML: there is no element"));
    if (problem_) return tl::unexpected(*problem_);
    return std::move(tags_);
  }

 private:
  void readMarkup() {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kSkipped{
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}}};
    for (const auto& [begin, end] : kSkipped)
      if (text_.substr(at_).starts_with(begin)) return skip(begin, end);
    if (text_.substr(at_).starts_with("</"))
      close();
    else
      open();
  }

  void skip(std::string_view begin, std::string_view end) {
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string_view::npos)
      return fail(at_, Message("xml.markup-open", "malformed XML: `{}` has no `{}` behind it", begin, end));
    at_ = found + end.size();
  }

  /// Behind the `>` that ends the tag; one in quotes does not.
  std::optional<std::size_t> endOfTag() const {
    char quote = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != 0)
        quote = c == quote ? '\0' : quote;
      else if (c == '"' || c == '\'')
        quote = c;
      else if (c == '>')
        return i + 1;
    }
    return std::nullopt;
  }

  std::string_view nameAt(std::size_t begin) const {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n/>", begin), text_.size());
    return text_.substr(begin, end - begin);
  }

  void open() {
    SdfTag tag;
    tag.begin = at_;
    tag.name = nameAt(at_ + 1);
    const auto end = endOfTag();
    if (!end) return fail(at_, Message("xml.tag-open", "malformed XML: the tag <{}> has no `>`", tag.name));
    if (common::asSeen(tag.name).find(' ') != std::string::npos) {
      const common::Misleading odd = *common::misleadingIn(tag.name);
      return fail(at_, Message("xml.misleading-name", "malformed XML: behind `<{}` is {}: write {}",
                               tag.name.substr(0, odd.offset), odd.what, odd.instead));
    }
    if (tag.name.empty() || tag.name.find_first_of("<\"'&=") != std::string_view::npos)
      return fail(at_, Message("xml.no-tag", "malformed XML: `<` begins no tag; in a text it is written &lt;"));
    const bool empty = text_[*end - 2] == '/';
    const std::size_t attributes = tag.begin + 1 + tag.name.size();
    tag.attributes = text_.substr(attributes, *end - attributes - (empty ? 2 : 1));
    if (!areQuoted(tag.attributes)) {
      fail(at_, Message("xml.no-quotes", "malformed XML: a value in the tag <{}> is not in quotes", tag.name));
      problem_->hint = common::misleadingHint(tag.attributes);
      return;
    }
    tag.content = tag.content_end = tag.end = *end;
    if (!open_.empty()) tag.parent = static_cast<int>(open_.back());
    if (!empty) open_.push_back(tags_.size());
    tags_.push_back(tag);
    at_ = *end;
  }

  void close() {
    const std::string_view name = nameAt(at_ + 2);
    const auto end = endOfTag();
    if (!end) return fail(at_, Message("xml.end-tag-open", "malformed XML: the tag </{}> has no `>`", name));
    if (open_.empty())
      return fail(at_, Message("xml.closes-nothing", "malformed XML: mismatched tag: </{}> closes nothing", name));
    SdfTag& tag = tags_[open_.back()];
    if (tag.name != name) {
      fail(at_, Message("xml.mismatched-tag",
                        "malformed XML: mismatched tag: </{}> where </{}> is expected, for the <{}> of line {}", name,
                        tag.name, tag.name, locationIn(file_, text_, tag.begin).line));
      problem_->hint = common::misleadingHint(common::printable(problem_->message.text()));
      return;
    }
    tag.content_end = at_;
    tag.end = *end;
    open_.pop_back();
    at_ = *end;
  }

  void fail(std::size_t offset, Message message) {
    problem_ = common::Problem{locationIn(file_, text_, offset), "", std::move(message), ""};
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<SdfTag> tags_;
  std::vector<std::size_t> open_;
  std::optional<common::Problem> problem_;
};

}  // namespace

common::SourceLocation locationIn(const std::string& file, std::string_view text, std::size_t offset) {
  // A line ends with "\n", "\r\n" or, of old systems, "\r".
  int line = 1;
  std::size_t line_begin = 0;
  for (std::size_t i = 0; i < std::min(offset, text.size()); ++i) {
    if (text[i] != '\n' && (text[i] != '\r' || text.substr(i + 1).starts_with('\n'))) continue;
    ++line;
    line_begin = i + 1;
  }
  return {file, line, 1 + static_cast<int>(std::min(offset, text.size()) - line_begin)};
}

tl::expected<std::vector<SdfTag>, common::Problem> readTags(const std::string& file, std::string_view text) {
  return TagReader(file, text).read();
}

std::optional<std::string_view> attributeOf(const SdfTag& tag, std::string_view name) {
  std::string_view rest = tag.attributes;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
    const std::size_t equals = rest.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const std::string_view key = rest.substr(0, std::min(rest.find_first_of(" \t\r\n="), rest.size()));
    const std::size_t quote = rest.find_first_of("\"'", equals);
    if (quote == std::string_view::npos) return std::nullopt;
    const std::size_t end = rest.find(rest[quote], quote + 1);
    if (end == std::string_view::npos) return std::nullopt;
    if (key == name) return rest.substr(quote + 1, end - quote - 1);
    rest.remove_prefix(end + 1);
  }
}

std::string textOf(const SdfTag& tag, std::string_view text) {
  constexpr std::string_view kComment = "<!--", kCommentEnd = "-->", kVerbatim = "<![CDATA[";
  std::string_view inside = common::trimmed(text.substr(tag.content, tag.content_end - tag.content), kSpace);
  while (inside.starts_with(kComment))
    inside = common::trimmed(inside.substr(inside.find(kCommentEnd, kComment.size()) + kCommentEnd.size()), kSpace);
  if (!inside.starts_with(kVerbatim))
    return withoutEntities(common::trimmed(inside.substr(0, inside.find('<')), kSpace));
  inside.remove_prefix(kVerbatim.size());
  return std::string(common::trimmed(inside.substr(0, inside.find("]]>")), kSpace));
}

}  // namespace swiftlet::simulation
