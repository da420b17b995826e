#include "common/yaml_problem.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/misleading.hpp"
#include "common/text_parts.hpp"
#include "common/utf16.hpp"

namespace swiftlet::common {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Whether a value or a key may follow on that character.
bool isBeforeValue(char c) { return std::string_view(":-[{,").find(c) != std::string_view::npos; }

/// The text before a comment, which a `#` within a word or quotes does not begin. Quotes are where a value or a key
/// begins.
std::string_view withoutComment(std::string_view line) {
  char quote = 0;
  bool begins = true;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool is_blank = kBlanks.find(c) != std::string_view::npos;
    if (quote != 0) {
      begins = c == quote;  // In single quotes two are one: the second opens them again.
      if (c == quote) quote = 0;
      continue;
    }
    if (c == '#' && (i == 0 || kBlanks.find(line[i - 1]) != std::string_view::npos)) return line.substr(0, i);
    if (begins && (c == '"' || c == '\'')) quote = c;
    if (!is_blank) begins = isBeforeValue(c);
  }
  return line;
}

/// The value in quotes, as YAML reads it.
std::string quoted(std::string_view value) {
  if (value.find('\'') != std::string_view::npos && value.find_first_of("\\\"") == std::string_view::npos)
    return fmt::format("\"{}\"", value);
  std::string text;
  for (const char c : value) text += c == '\'' ? "''" : std::string(1, c);
  return "'" + text + "'";
}

bool isNothing(std::string_view line) { return trimmed(withoutComment(line)).empty(); }

std::size_t indentOf(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

/// "laser" of "  - laser: utm" and of "laser = utm"; empty without a colon or equals sign behind a word.
std::string_view keyOf(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t-"), line.size()));
  const std::size_t end = std::min(line.find_first_of(":= \t\"'[]{},"), line.size());
  const std::string_view next = trimmed(line.substr(end));
  return next.starts_with(':') || next.starts_with('=') ? line.substr(0, end) : std::string_view();
}

/// The message for a text that is not YAML: where, what and how to mend it.
struct Cause {
  int line = 0, column = 0;
  Message message;
  std::string hint;
};

/// One look at a text in which the library noticed something at a line and column, both from 1.
class Diagnosis {
 public:
  Diagnosis(std::string_view text, int line, int column, std::string said)
      : lines_(linesOf(text)),
        said_(std::move(said)),
        noticed_{std::clamp(line, 1, static_cast<int>(lines_.size())), column,
                 Message("yaml.malformed", "not YAML: {}", said_), ""} {}

  Cause cause() const {
    for (const auto look : {&Diagnosis::conflict, &Diagnosis::lookalike, &Diagnosis::tab, &Diagnosis::unclosed,
                            &Diagnosis::colonOrEquals, &Diagnosis::indentation, &Diagnosis::value})
      if (auto found = (this->*look)()) return *found;
    return noticed_;
  }

 private:
  std::string_view lineAt(int line) const { return lines_[static_cast<std::size_t>(line) - 1]; }

  /// The last line up to `line` that has more than a comment, or 0.
  int contentAt(int line) const {
    while (line > 0 && isNothing(lineAt(line))) --line;
    return line;
  }

  /// The line where something was noticed, and the one above, which may be the cause.
  std::vector<int> suspects() const {
    const int above = contentAt(noticed_.line - 1);
    return above > 0 ? std::vector<int>{noticed_.line, above} : std::vector<int>{noticed_.line};
  }

  Cause with(std::string hint) const { return {noticed_.line, noticed_.column, noticed_.message, std::move(hint)}; }

  std::optional<Cause> conflict() const {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].starts_with("<<<<<<< "))
        return Cause{
            static_cast<int>(i) + 1, 1,
            Message("yaml.merge-conflict", "not YAML: two versions of the file were merged and left unresolved here"),
            "keep one of the two, and take out the lines that begin with <<<<<<<, ======= and >>>>>>>"};
    return std::nullopt;
  }

  std::optional<Cause> lookalike() const {
    for (const int line : suspects())
      if (std::string hint = lookalikeHint(lines_, line); !hint.empty())
        return Cause{line, 1, noticed_.message, std::move(hint)};
    return std::nullopt;
  }

  std::optional<Cause> tab() const {
    for (const int line : {noticed_.line, noticed_.line - 1}) {
      if (line < 1) continue;
      const std::string_view indent = lineAt(line).substr(0, lineAt(line).find_first_not_of(" \t"));
      if (indent.find('\t') != std::string_view::npos) return with("YAML is indented by spaces, not tabs");
    }
    return std::nullopt;
  }

  std::optional<Cause> unclosed() const;
  std::optional<Cause> indentation() const;

  std::optional<Cause> colonOrEquals() const {
    for (const int line : suspects())
      if (std::string hint = keyHint(trimmed(withoutComment(lineAt(line)))); !hint.empty())
        return Cause{line, static_cast<int>(indentOf(lineAt(line))) + 1, noticed_.message, std::move(hint)};
    return std::nullopt;
  }

  std::optional<Cause> value() const {
    const std::string_view line = trimmed(withoutComment(lineAt(noticed_.line)));
    const std::size_t colon = line.find(": ");
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view written = trimmed(line.substr(colon + 2));
    if (written.starts_with('\'') && std::count(written.begin(), written.end(), '\'') > 2)
      return with(fmt::format("within single quotes an apostrophe is written twice: write `{}: {}`",
                              line.substr(0, colon), quoted(written.substr(1, written.size() - 2))));
    if (written.starts_with('"') && written.find('\\') != std::string_view::npos)
      return with("in double quotes a backslash begins a special character: use single quotes");
    if (said_ == "illegal flow end") return with("leave out that bracket: none is open there");
    const bool special = !written.empty() && std::string_view("@`%*&!|>").find(written[0]) != std::string_view::npos;
    if (special || written.find(": ") != std::string_view::npos)
      return with(fmt::format("put quotes around the value: `{}: {}`", line.substr(0, colon), quoted(written)));
    return std::nullopt;
  }

  std::vector<std::string_view> lines_;
  std::string said_;  ///< By the library.
  Cause noticed_;
};

/// A quote or a bracket that is open at the end of the text. A quote is one where a value or a key begins.
std::optional<Cause> Diagnosis::unclosed() const {
  struct Open {
    char what;
    int line, column;
  };
  std::vector<Open> open;
  bool begins = true;  // A value or a key may begin here.
  for (int line = 1; line <= static_cast<int>(lines_.size()); ++line) {
    const std::string_view text = lineAt(line);
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      const bool quoted = !open.empty() && (open.back().what == '"' || open.back().what == '\'');
      if (quoted) {
        if (c == '\\' && open.back().what == '"')
          ++i;
        else if (c == open.back().what)
          open.pop_back();
        continue;
      }
      if (c == '#' && (i == 0 || kBlanks.find(text[i - 1]) != std::string_view::npos)) break;
      const bool in_flow = !open.empty();
      if ((begins && (c == '"' || c == '\'' || c == '[' || c == '{')) || (in_flow && (c == '[' || c == '{')))
        open.push_back({c, line, static_cast<int>(i) + 1});
      else if (in_flow && (c == ']' || c == '}'))
        open.pop_back();
      if (c != ' ') begins = isBeforeValue(c);
    }
    begins = true;
  }
  if (open.empty()) return std::nullopt;
  // Of brackets the innermost, of which the closing one of an outer may have been taken.
  const Open& last = open.back();
  const char close = last.what == '[' ? ']' : last.what == '{' ? '}' : last.what;
  return Cause{last.line, last.column, Message("yaml.not-closed", "not YAML: the `{}` is never closed", last.what),
               fmt::format("put a `{}` where it ends", close)};
}

/// A line that begins between the columns in which those above begin, or deeper than one that has a value.
std::optional<Cause> Diagnosis::indentation() const {
  const int line = noticed_.line;
  if (isNothing(lineAt(line))) return std::nullopt;
  std::vector<std::size_t> columns;
  for (int above = 1; above < line; ++above) {
    if (isNothing(lineAt(above))) continue;
    std::size_t indent = indentOf(lineAt(above));
    while (!columns.empty() && columns.back() > indent) columns.pop_back();
    if (columns.empty() || columns.back() < indent) columns.push_back(indent);
    // The keys of an item begin behind its dash.
    const std::string_view item = lineAt(above).substr(indent);
    if (item.starts_with("- ")) columns.push_back(indent + item.find_first_not_of(" -"));
  }
  const std::size_t indent = indentOf(lineAt(line));
  const auto next = std::lower_bound(columns.begin(), columns.end(), indent);
  const int column = static_cast<int>(indent) + 1;
  const bool is_aligned = next != columns.end() && *next == indent;
  const bool is_item = lineAt(line).substr(indent).starts_with("- ");
  const int above = contentAt(line - 1);
  const std::string_view list = above > 0 ? trimmed(withoutComment(lineAt(above))) : "";
  if (is_aligned && is_item && list.ends_with(':'))
    return Cause{line, column,
                 Message("yaml.item-left-of-key", "not YAML: an item of a list stands left of its key `{}`",
                         list.substr(0, list.size() - 1)),
                 fmt::format("begin it in column {}", indentOf(lineAt(above)) + 1)};
  if (is_aligned && is_item)
    return Cause{line, column,
                 Message("yaml.item-for-key", "not YAML: an item of a list stands where a key is expected"),
                 "leave out the dash, or give the list a key of its own"};
  if (columns.empty() || is_aligned) return std::nullopt;
  if (next == columns.end())
    return Cause{
        line, column,
        Message("yaml.below-a-value", "not YAML: is indented deeper than the line above, which has a value already"),
        fmt::format("begin it in column {}", columns.back() + 1)};
  const std::string or_lower = next == columns.begin() ? "" : fmt::format(" or {}", *std::prev(next) + 1);
  return Cause{line, column,
               Message("yaml.other-column", "not YAML: begins in column {}, where no key above it does", column),
               fmt::format("begin it in column {}{}", *next + 1, or_lower)};
}

Problem notYaml(const std::string& text, const std::string& file, const YAML::Exception& e) {
  const Cause cause = Diagnosis(text, e.mark.line + 1, e.mark.column + 1, e.msg).cause();
  const std::vector<std::string_view> lines = linesOf(text);
  return {{file, cause.line, cause.column},
          std::string(keyOf(lines[static_cast<std::size_t>(cause.line) - 1])),
          cause.message,
          cause.hint};
}

/// The library takes what follows on a complete text as a second one, with `---` between them or without.
Problem secondDocument(const std::string& text, const std::string& file, int line) {
  const std::vector<std::string_view> lines = linesOf(text);
  int first = 0;  // The first line with more than a comment.
  for (int above = line - 1; above > 0; --above) {
    const std::string_view one = lines[static_cast<std::size_t>(above) - 1];
    if (one.starts_with("---") && first > 0)
      first = above;
    else if (one.starts_with("---"))
      return {{file, line, 1},
              "",
              Message("yaml.second-document", "a second document begins above this line"),
              "leave out the line `---`, or give each its own file"};
    else if (!isNothing(one))
      first = above;
  }
  if (first == 0)
    return {{file, line, 1},
            "",
            Message("yaml.behind-a-value", "not YAML: the line goes on behind a value that is complete"),
            ""};
  const std::string_view head = lines[static_cast<std::size_t>(first) - 1];
  const std::string_view key = trimmed(withoutComment(head));
  if (const std::size_t indent = indentOf(head); indent > 0)
    return {{file, first, static_cast<int>(indent) + 1},
            std::string(keyOf(head)),
            Message("yaml.first-indented", "not YAML: is indented deeper than line {}, which follows on it", line),
            "begin it in column 1"};
  if (key.starts_with('[') && key.ends_with(']'))
    return {{file, first, 1},
            "",
            Message("yaml.ini-section", "not YAML: `{}` heads a section in an INI file", key),
            fmt::format("write `{}:`, and below it, indented, each setting as `key: value`",
                        key.substr(1, key.size() - 2))};
  return {{file, line, 1},
          "",
          Message("yaml.complete-above", "not YAML: what stands above is complete without this line"),
          keyHint(trimmed(withoutComment(lines[static_cast<std::size_t>(line) - 1])))};
}

/// The library decodes it.
bool isUtf32(std::string_view text) {
  using namespace std::string_view_literals;
  return text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv);
}

}  // namespace

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string yamlText(std::string bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (isUtf32(bytes)) return bytes;
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, kByteOrderMark.size());
  if (const auto order = utf16OrderOf(bytes)) {
    const std::string utf16 = std::exchange(bytes, "");
    Utf16Decoder decoder(*order);
    decoder.decode(utf16, bytes);
    decoder.finish(bytes);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i)  // Lines that end as on old Macs.
    if (bytes[i] == '\r' && !std::string_view(bytes).substr(i + 1).starts_with('\n')) bytes[i] = '\n';
  return bytes;
}

YAML::Node loadYaml(const std::string& text, const std::string& file) {
  try {
    // The mark for the end of a document makes the library notice a quote that is open there.
    const std::vector<YAML::Node> documents = YAML::LoadAll(isUtf32(text) ? text : text + "\n...\n");
    for (std::size_t i = 1; i < documents.size(); ++i)
      if (!documents[i].IsNull()) throw InputError(secondDocument(text, file, documents[i].Mark().line + 1));
    return documents.empty() ? YAML::Node() : documents.front();
  } catch (const YAML::Exception& e) {
    throw InputError(notYaml(text, file, e));
  }
}

std::string lookalikeHint(const std::vector<std::string_view>& lines, int line) {
  if (line < 1 || line > static_cast<int>(lines.size())) return "";
  const std::string_view content = withoutComment(lines[static_cast<std::size_t>(line) - 1]);
  const auto found = misleadingIn(content);
  if (!found) return "";
  return fmt::format("line {} has {} in column {}: write {}", line, found->what, found->offset + 1, found->instead);
}

std::string keyHint(std::string_view written) {
  const bool dash = written.size() > 1 && written[0] == '-' &&
                    std::string_view(" -.0123456789").find(written[1]) == std::string_view::npos;
  if (dash && written.find(':') != std::string_view::npos)
    return fmt::format("put a blank behind the dash: `- {}`", written.substr(1));
  if (written.starts_with("- ")) written = trimmed(written.substr(2));
  const std::string_view key = keyOf(written);
  const std::string_view rest = trimmed(written.substr(key.size()));
  const std::string_view value = trimmed(rest.substr(std::min<std::size_t>(1, rest.size())));
  if (key.empty() || !written.starts_with(key) || value.empty()) return "";
  if (rest[0] == '=') return fmt::format("write `{}: {}`", key, value);
  if (kBlanks.find(rest[1]) != std::string_view::npos || value.starts_with("//")) return "";
  return fmt::format("put a blank behind the colon: `{}: {}`", key, value);
}

}  // namespace swiftlet::common
