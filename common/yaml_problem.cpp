#include "common/yaml_problem.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/misleading.hpp"

namespace swiftlet::common {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// The text before a comment. A `#` within a word or quotes begins none.
std::string_view withoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins = i == 0 || kBlanks.find(line[i - 1]) != std::string_view::npos;
    if (quote != 0 ? line[i] == quote : (line[i] == '"' || line[i] == '\'')) quote = quote != 0 ? 0 : line[i];
    if (quote == 0 && line[i] == '#' && begins) return line.substr(0, i);
  }
  return line;
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

/// What a text that is not YAML is told: where, what and how to mend it.
struct Cause {
  int line = 0, column = 0;
  std::string message, hint;
};

/// One look at a text in which the library noticed something at a line and column, both from 1.
class Diagnosis {
 public:
  Diagnosis(std::string_view text, int line, int column, std::string message)
      : lines_(linesOf(text)),
        noticed_{std::clamp(line, 1, static_cast<int>(lines_.size())), column, std::move(message), ""} {}

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
        return Cause{static_cast<int>(i) + 1, 1, "two versions of the file were merged and left unresolved here",
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
      return with(
          fmt::format("within single quotes an apostrophe is written twice; double quotes need none of that: "
                      "`{}: \"{}\"`",
                      line.substr(0, colon), written.substr(1, written.size() - 2)));
    if (written.starts_with('"') && written.find('\\') != std::string_view::npos)
      return with("in double quotes a backslash begins a special character: use single quotes");
    if (noticed_.message == "illegal flow end") return with("leave out that bracket: none is open there");
    const bool special = !written.empty() && std::string_view("@`%*&!|>").find(written[0]) != std::string_view::npos;
    if (special || written.find(": ") != std::string_view::npos)
      return with(fmt::format("put quotes around the value: `{}: '{}'`", line.substr(0, colon), written));
    return std::nullopt;
  }

  std::vector<std::string_view> lines_;
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
      if (c != ' ') begins = c == ':' || c == '-' || c == '[' || c == '{' || c == ',';
    }
    begins = true;
  }
  if (open.empty()) return std::nullopt;
  // Of brackets the innermost, of which the closing one of an outer may have been taken.
  const Open& last = open.back();
  const char close = last.what == '[' ? ']' : last.what == '{' ? '}' : last.what;
  return Cause{last.line, last.column, fmt::format("the `{}` is never closed", last.what),
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
                 fmt::format("an item of a list stands left of its key `{}`", list.substr(0, list.size() - 1)),
                 fmt::format("begin it in column {}", indentOf(lineAt(above)) + 1)};
  if (is_aligned && is_item)
    return Cause{line, column, "an item of a list stands where a key is expected",
                 "leave out the dash, or give the list a key of its own"};
  if (columns.empty() || is_aligned) return std::nullopt;
  if (next == columns.end())
    return Cause{line, column, "is indented deeper than the line above, which has a value already",
                 fmt::format("begin it in column {}", columns.back() + 1)};
  const std::string or_lower = next == columns.begin() ? "" : fmt::format(" or {}", *std::prev(next) + 1);
  return Cause{line, column, fmt::format("begins in column {}, where no key above it does", column),
               fmt::format("begin it in column {}{}", *next + 1, or_lower)};
}

Problem notYaml(const std::string& text, const std::string& file, const YAML::Exception& e) {
  const Cause cause = Diagnosis(text, e.mark.line + 1, e.mark.column + 1, e.msg).cause();
  const std::vector<std::string_view> lines = linesOf(text);
  return {{file, cause.line, cause.column},
          std::string(keyOf(lines[static_cast<std::size_t>(cause.line) - 1])),
          "not YAML: " + cause.message,
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
              "a second document begins above this line",
              "leave out the line `---`, or give each its own file"};
    else if (!isNothing(one))
      first = above;
  }
  if (first == 0) return {{file, line, 1}, "", "not YAML: this line follows on nothing", ""};
  const std::string_view head = lines[static_cast<std::size_t>(first) - 1];
  const std::string_view key = trimmed(withoutComment(head));
  if (const std::size_t indent = indentOf(head); indent > 0)
    return {{file, first, static_cast<int>(indent) + 1},
            std::string(keyOf(head)),
            fmt::format("not YAML: is indented deeper than line {}, which follows on it", line),
            "begin it in column 1"};
  if (key.starts_with('[') && key.ends_with(']'))
    return {{file, first, 1},
            "",
            fmt::format("not YAML: `{}` heads a section in an INI file", key),
            fmt::format("write `{}:`, and below it, indented, each setting as `key: value`",
                        key.substr(1, key.size() - 2))};
  return {{file, line, 1},
          "",
          "not YAML: what stands above is complete without this line",
          keyHint(trimmed(withoutComment(lines[static_cast<std::size_t>(line) - 1])))};
}

/// "m_s" of "m/s" and "m_s", "deg" of "°".
std::string unitOf(std::string_view written) {
  std::string unit;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const std::string_view rest = written.substr(i);
    if (rest.starts_with("\xC2\xB0") || rest.starts_with("\xC2\xB2")) {
      unit += rest.starts_with("\xC2\xB0") ? "deg" : "2";
      ++i;
    } else if (rest.starts_with("\xB0")) {  // In Latin-1.
      unit += "deg";
    } else if (written[i] != '^') {
      unit += written[i] == '/' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(written[i])));
    }
  }
  return unit;
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

YAML::Node loadYaml(const std::string& given, const std::string& file) {
  std::string text = given;
  // Lines that end as on old Macs.
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  try {
    // The mark for the end of a document makes the library notice a quote that is open there.
    const std::vector<YAML::Node> documents = YAML::LoadAll(is_utf16 ? text : text + "\n...\n");
    for (std::size_t i = 1; i < documents.size(); ++i)
      if (!documents[i].IsNull()) throw InputError(secondDocument(text, file, documents[i].Mark().line + 1));
    return documents.empty() ? YAML::Node() : documents.front();
  } catch (const YAML::Exception& e) {
    throw InputError(notYaml(text, file, e));
  }
}

std::string numberHint(std::string_view key, std::string_view written, bool whole) {
  if (std::string hint = misleadingHint(written); !hint.empty()) return hint;
  const std::string_view text = trimmed(written);
  std::size_t end = 0;
  std::string number;
  int marks = 0;
  for (; end < text.size(); ++end) {
    const char c = text[end];
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool digit_next = end + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0;
    const bool sign = end == 0 && (c == '-' || c == '+');
    if (c == ',' || c == '.') ++marks;
    if (digit || sign)
      number += c;
    else if (c == ',' || c == '.')
      number += '.';
    else if (!(end > 0 && digit_next && (c == ' ' || c == '_' || c == '\'')))
      break;
  }
  if (number.find_first_of("0123456789") == std::string::npos) return "";
  // "1,081" may be a thousand or one; "0,081" is one.
  const std::size_t comma = text.find(',');
  const bool ambiguous = comma != std::string_view::npos && end == comma + 4 && text.find_first_of("123456789") < comma;
  if (!whole && (marks > 1 || ambiguous)) return "write decimals with a point, and no other marks";
  if (whole && marks > 0)
    return comma == std::string_view::npos ? "" : "write a whole number, without points or commas";
  const std::string_view rest = trimmed(text.substr(end));
  if (rest.empty()) return number == text ? "" : fmt::format("write `{}`", number);
  if (rest.starts_with('#')) return fmt::format("put a blank before the comment: `{} {}`", number, rest);
  if (rest.find_first_of("]}") == 0) return fmt::format("leave out the `{}`: no bracket is open there", rest[0]);
  constexpr std::array<std::string_view, 12> kUnits{"m",  "s", "s2", "deg", "rad", "hz",
                                                    "kg", "v", "n",  "ah",  "px",  "m2"};
  const bool has_unit = std::find(kUnits.begin(), kUnits.end(), key.substr(key.rfind('_') + 1)) != kUnits.end();
  if (rest == "%" && !has_unit)
    return fmt::format("write `{}`: shares are of 1", std::strtod(number.c_str(), nullptr) / 100.0);
  const std::string unit = unitOf(rest);
  if (key.ends_with("_" + unit)) return fmt::format("write `{}`: the key's name has the unit", number);
  if (has_unit) return "write the number alone, in the unit that the key's name ends with";
  const bool has_exponent = std::tolower(static_cast<unsigned char>(rest[0])) == 'e' && rest.size() > 1;
  if (has_exponent) return "";
  return key.empty() ? "write the number alone, in the unit that --help names"
                     : "write the number alone, in the unit in which it is described";
}

std::string lookalikeHint(const std::vector<std::string_view>& lines, int line) {
  if (line < 1 || line > static_cast<int>(lines.size())) return "";
  const std::string_view content = withoutComment(lines[static_cast<std::size_t>(line) - 1]);
  // At the beginning of a file it is read as intended.
  const std::size_t mark = line == 1 && content.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const auto found = misleadingIn(content.substr(mark));
  if (!found) return "";
  return fmt::format("line {} has {} in column {}: write {}", line, found->what, mark + found->offset + 1,
                     found->instead);
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
