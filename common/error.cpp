#include "common/error.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "common/lower_case.hpp"
#include "common/misleading.hpp"
#include "common/printable.hpp"

namespace swiftlet::common {
namespace {

std::string joinProblems(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += toString(problem);
  }
  return text;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string toString(const SourceLocation& location) {
  std::string text = printable(location.file);
  if (location.line > 0) text += fmt::format(":{}", location.line);
  if (location.line > 0 && location.column > 0) text += fmt::format(":{}", location.column);
  return text;
}

std::string toString(const Problem& problem) {
  std::string text = toString(problem.location);
  for (const std::string* part : {&problem.element, &problem.message.text()}) {
    if (part->empty()) continue;
    if (!text.empty()) text += ": ";
    text += printable(*part);
  }
  if (!problem.hint.empty()) text += ", " + printable(problem.hint);
  return text;
}

Message messageOf(const Problem& problem) { return Message(problem.message.name(), "{}", toString(problem)); }

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

InputError::InputError(SourceLocation location, std::string element, Message message, std::string hint)
    : InputError(Problem{std::move(location), std::move(element), std::move(message), std::move(hint)}) {}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(joinProblems(problems)), problems_(std::move(problems)) {}

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates) {
  // `p` for `P`, which share no letter.
  const auto same = [seen = lowerCase(asSeen(word))](const auto& one) { return lowerCase(asSeen(one)) == seen; };
  if (const auto found = std::find_if(candidates.begin(), candidates.end(), same); found != candidates.end())
    return *found;
  // `roll` for `roll_deg`, `fx` for `fx_px`.
  const auto begins = [&](const std::string& candidate) { return word.size() >= 2 && candidate.starts_with(word); };
  if (const auto found = std::find_if(candidates.begin(), candidates.end(), begins); found != candidates.end())
    return *found;
  const std::string* best = nullptr;
  // Where every letter would have to change, the words are not similar.
  std::size_t best_distance = std::min(std::max<std::size_t>(2, word.size() / 3) + 1, word.size());
  const auto begin = [&](const std::string& candidate) {
    return std::mismatch(word.begin(), word.end(), candidate.begin(), candidate.end()).first - word.begin();
  };
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(word, candidate);
    // Of two equally near words, the one with the same beginning: `speed` for `sped`, before `seed`.
    const bool begins_alike = best != nullptr && distance == best_distance && begin(candidate) > begin(*best);
    if (distance < best_distance || begins_alike) {
      best_distance = distance;
      best = &candidate;
    }
  }
  if (best == nullptr) return std::nullopt;
  return *best;
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
  const auto nearest = nearestWord(word, candidates);
  if (!nearest) return {};
  const auto odd = misleadingIn(*nearest);
  return fmt::format("did you mean `{}`{}?", *nearest, odd ? fmt::format(", which has {}", odd->what) : "");
}

}  // namespace swiftlet::common
