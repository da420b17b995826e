#include "behaviors/tree/outcome_script.hpp"

#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace swiftlet::tree {
namespace {

/// A longer script is a mistake, and must not fill the memory.
constexpr int kMostAnswers = 100'000;

std::string_view withoutBlanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// `#` begins a comment at the start of a line and, after blanks, behind the answers: names of leaves may hold one.
std::string_view withoutComment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    const std::string_view before = line.substr(0, at);
    const bool behind = before.find(':') != std::string_view::npos && (before.back() == ' ' || before.back() == '\t');
    if (withoutBlanks(before).empty() || behind) return before;
  }
  return line;
}

std::optional<int> countOf(std::string_view text, int most) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count < 1 || count > most) return std::nullopt;
  return count;
}

std::optional<Status> scriptedAnswer(std::string_view word) {
  if (word == "true") return Status::kSuccess;
  if (word == "false") return Status::kFailure;
  return answerFrom(word);
}

class ScriptLines {
 public:
  explicit ScriptLines(std::string file) : file_(std::move(file)) {}

  OutcomeScript read(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    for (int line = 1; !text.empty(); ++line) {
      const std::size_t end = text.find('\n');
      readLine(text.substr(0, end), line);
      text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return std::move(script_);
  }

 private:
  void readLine(std::string_view line, int number) {
    const std::string_view content = withoutBlanks(withoutComment(line));
    if (content.empty()) return;
    const auto column = static_cast<int>(content.data() - line.data()) + 1;
    const Location place{file_, number, column};
    // The last colon, because names may have some.
    const std::size_t colon = content.rfind(':');
    if (colon == std::string_view::npos || withoutBlanks(content.substr(0, colon)).empty()) {
      script_.problems.push_back({place, {}, Message("tree.answers-line", "expected `LEAF: ANSWER, ANSWER x3, ...`")});
      return;
    }
    const std::string key(withoutBlanks(content.substr(0, colon)));
    const std::string_view value = withoutBlanks(content.substr(colon + 1));
    if (key == "ticks" || key == "tick_ms")
      readSetting(key, value, place);
    else
      readAnswers(key, value, place);
  }

  void readSetting(const std::string& key, std::string_view value, const Location& place) {
    const auto count = countOf(value, kMostAnswers);
    if (!count)
      script_.problems.push_back(
          {place, key, Message("tree.answers-count", "`{}` is not a whole number from 1 to 100000", value)});
    else
      (key == "ticks" ? script_.ticks : script_.tick_ms) = *count;
  }

  void readAnswers(const std::string& leaf, std::string_view value, const Location& place) {
    ScriptedAnswers scripted{leaf, {}, place};
    if (const auto [first, is_new] = lines_.try_emplace(leaf, place.line); !is_new) {
      script_.problems.push_back({place, leaf,
                                  Message("tree.answers-twice", "is named twice, first in line {}", first->second),
                                  "write all its answers in one line"});
      return;
    }
    while (true) {
      const std::size_t comma = value.find(',');
      if (!readAnswer(withoutBlanks(value.substr(0, comma)), scripted)) return;
      if (comma == std::string_view::npos) break;
      value = value.substr(comma + 1);
    }
    script_.leaves.push_back(std::move(scripted));
  }

  /// "RUNNING" or "RUNNING x3".
  bool readAnswer(std::string_view text, ScriptedAnswers& scripted) {
    const std::size_t blank = text.find_first_of(" \t");
    const auto answer = scriptedAnswer(text.substr(0, blank));
    std::string_view times =
        blank == std::string_view::npos ? std::string_view("x1") : withoutBlanks(text.substr(blank));
    const bool counted = times.starts_with('x');
    if (counted) times.remove_prefix(1);
    const auto count = countOf(withoutBlanks(times), kMostAnswers - static_cast<int>(scripted.answers.size()));
    if (answer && counted && count) {
      scripted.answers.insert(scripted.answers.end(), static_cast<std::size_t>(*count), *answer);
      return true;
    }
    script_.problems.push_back({scripted.location, scripted.leaf,
                                Message("tree.unknown-answer", "`{}` is not an answer", text),
                                "expected RUNNING, SUCCESS, FAILURE, SKIPPED, true or false, as in `RUNNING x3`"});
    return false;
  }

  std::string file_;
  OutcomeScript script_;
  std::map<std::string, int, std::less<>> lines_;  ///< Of the leaves that are named.
};

}  // namespace

OutcomeScript readOutcomeScript(std::string_view text, const std::string& file) { return ScriptLines(file).read(text); }

}  // namespace swiftlet::tree
