// Lines in which each word is a number with a name, as in files of trajectories and relations. Errors name the place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {

struct LineFormat {
  std::string_view element;              ///< What a line describes, such as "pose".
  std::vector<std::string_view> fields;  ///< Names of the words, such as "t" and "x".
};

/// "`t x y z`", for messages.
std::string toString(const LineFormat& format);

/// "the numbers are separated by commas" with a remedy where the first word has one; empty otherwise.
std::string commaHint(const std::vector<Word>& words);

/// The words of the next line that is neither blank nor a comment (`#`); they are valid until the next call. False
/// after the last line.
bool nextWords(LineReader& reader, std::vector<Word>& words);

/// The words of the last line read, as numbers.
class LineFields {
 public:
  /// Throws InputError if the number of words is not that of the fields. All three arguments outlive this.
  LineFields(const LineReader& reader, const std::vector<Word>& words, const LineFormat& format);

  /// Throw InputError if the word is not a time in seconds, or not a finite number.
  common::Time stamp(std::size_t field) const;
  double number(std::size_t field) const;
  /// Throw InputError also if the magnitude of the value is above `greatest`, or if it is not within the two.
  double numberWithin(std::size_t field, double greatest) const { return numberWithin(field, -greatest, greatest); }
  double numberWithin(std::size_t field, double least, double greatest) const;
  /// 1 or 0. Throws InputError for anything else.
  bool flag(std::size_t field) const;
  /// Throws InputError also if the value is beyond kFarthest_m.
  double coordinate_m(std::size_t field) const;

  /// A problem at that field, to throw.
  common::InputError problemAt(std::size_t field, std::string element, common::Message message,
                               std::string hint = "") const;

 private:
  /// The same, named as the field.
  common::InputError problemAt(std::size_t field, common::Message message, std::string hint = "") const;
  std::string hintFor(std::string_view word) const;

  const LineReader& reader_;
  const std::vector<Word>& words_;
  const LineFormat& format_;
};

}  // namespace swiftlet::interfaces
