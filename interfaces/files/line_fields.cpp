#include "interfaces/files/line_fields.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interfaces/files/stamp_units.hpp"

namespace swiftlet::interfaces {

using common::Message;

std::string toString(const LineFormat& format) { return fmt::format("`{}`", fmt::join(format.fields, " ")); }

std::string commaHint(const std::vector<Word>& words) {
  const std::string_view first = words.empty() ? "" : words.front().text;
  if (const std::size_t comma = first.find(','); comma == std::string_view::npos || comma == 0) return "";
  // EuRoC has nanoseconds, and w before x, y and z.
  const bool nanoseconds = first.substr(0, first.find(',')).find('.') == std::string_view::npos;
  return nanoseconds ? "the numbers are separated by commas; if this is of EuRoC, `evo_traj euroc FILE --save_as_tum` "
                       "writes what was expected"
                     : "the numbers are separated by commas: put spaces there, for instance by `tr ',' ' ' < FILE`";
}

bool nextWords(LineReader& reader, std::vector<Word>& words) {
  std::string_view line;
  while (reader.next(line)) {
    words = wordsOf(line);
    if (!words.empty() && !words[0].text.starts_with('#')) return true;
  }
  return false;
}

LineFields::LineFields(const LineReader& reader, const std::vector<Word>& words, const LineFormat& format)
    : reader_(reader), words_(words), format_(format) {
  if (words.size() == format.fields.size()) return;
  const std::string commas = commaHint(words);
  throw problemAt(words.size() - 1, std::string(format.element),
                  Message("text.number-count", "{} numbers instead of {}", words.size(), format.fields.size()),
                  "expected " + toString(format) + (commas.empty() ? "" : "; " + commas));
}

common::Time LineFields::stamp(std::size_t field) const {
  if (const auto stamp = parseStamp(words_[field].text)) return *stamp;
  const std::string unit = stampUnitHint(words_[field].text);
  throw problemAt(field, Message("text.not-a-time", "`{}` is not a time in seconds", words_[field].text),
                  unit.empty() ? hintFor(words_[field].text) : unit);
}

double LineFields::number(std::size_t field) const {
  double value = 0.0;
  if (parseNumber(words_[field].text, value)) return value;
  throw problemAt(field, Message("text.not-finite", "`{}` is not a finite number", words_[field].text),
                  hintFor(words_[field].text));
}

double LineFields::coordinate_m(std::size_t field) const {
  const double value_m = number(field);
  if (std::abs(value_m) <= kFarthest_m) return value_m;
  throw problemAt(field, Message("text.too-far", "is farther away than {} m", kFarthest_m));
}

double LineFields::numberWithin(std::size_t field, double least, double greatest) const {
  const double value = number(field);
  if (value >= least && value <= greatest) return value;
  throw problemAt(field,
                  Message("text.out-of-bounds", "`{}` is not from {} to {}", words_[field].text, least, greatest));
}

bool LineFields::flag(std::size_t field) const {
  const double value = number(field);
  if (value == 0.0 || value == 1.0) return value == 1.0;
  throw problemAt(field, Message("text.no-flag", "`{}` is neither 0 nor 1", words_[field].text));
}

std::string LineFields::hintFor(std::string_view word) const {
  std::string comma = decimalCommaHint(word);
  return comma.empty() ? "expected " + toString(format_) : comma;
}

common::InputError LineFields::problemAt(std::size_t field, std::string element, Message message,
                                         std::string hint) const {
  return reader_.problemAt(words_[field].column, std::move(element), std::move(message), std::move(hint));
}

common::InputError LineFields::problemAt(std::size_t field, Message message, std::string hint) const {
  return problemAt(field, std::string(format_.fields[field]), std::move(message), std::move(hint));
}

}  // namespace swiftlet::interfaces
