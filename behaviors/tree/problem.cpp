#include "behaviors/tree/problem.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "behaviors/tree/characters.hpp"
#include "behaviors/tree/value.hpp"

namespace swiftlet::tree {
namespace {

/// Lower case of ASCII letters, independent of the locale.
std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

/// The shortest candidate that goes on where the word, in lower case, ends: MoveToGoal for MoveTo. Null if none does.
const std::string* completed(std::string_view low, std::span<const std::string> candidates) {
  constexpr std::size_t kShortest = 3;
  const std::string* best = nullptr;
  for (const std::string& candidate : candidates)
    if (low.size() >= kShortest && lowered(candidate).starts_with(low) &&
        (best == nullptr || candidate.size() < best->size()))
      best = &candidate;
  return best;
}

const std::string* nearest(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kMost = 1000;  // Bounded for speed, because each problem searches it.
  candidates = candidates.first(std::min(candidates.size(), kMost));
  for (const std::string& candidate : candidates)
    if (withoutUnit(candidate) == withoutUnit(word)) return &candidate;
  // A longer name is not a typing error, and the distance takes quadratic time.
  constexpr std::size_t kLongestName = 100;
  if (word.size() > kLongestName) return nullptr;
  for (const std::string& candidate : candidates)
    if (candidate.size() <= 4 * kLongestName && asSeen(candidate) == asSeen(word)) return &candidate;
  const std::string low = lowered(word);
  const std::string* best = nullptr;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestName) continue;
    const std::size_t distance = editDistance(low, lowered(candidate));
    if (distance < best_distance && distance < candidate.size()) {
      best_distance = distance;
      best = &candidate;
    }
  }
  return best == nullptr ? completed(low, candidates) : best;
}

}  // namespace

std::string toString(const Location& location) {
  std::string text = location.file;
  if (location.line > 0) text += fmt::format(":{}", location.line);
  if (location.line > 0 && location.column > 0) text += fmt::format(":{}", location.column);
  return text;
}

std::string toString(const Problem& problem) {
  std::string text = toString(problem.location);
  for (const std::string* part : {&problem.element, &problem.message.text()})
    if (!part->empty()) text += (text.empty() ? "" : ": ") + *part;
  if (!problem.hint.empty()) text += ", " + problem.hint;
  return text;
}

std::string toString(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += toString(problem) + "\n";
  return text;
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
  const std::string* best = nearest(word, candidates);
  if (best == nullptr) return {};
  const std::string misleads = misleadingCharacterIn(*best);
  return fmt::format("did you mean `{}`{}{}?", *best, misleads.empty() ? "" : ", which holds ", misleads);
}

std::string quotedList(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
  return text;
}

}  // namespace swiftlet::tree
