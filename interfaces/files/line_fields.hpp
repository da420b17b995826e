// Lines of which each word is a number with a name, as trajectories and relations are written. Mistakes say where.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "common/time.hpp"
#include "interfaces/files/line_reader.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {

struct LineFormat {
  std::string_view element;              ///< What a line is: "pose".
  std::vector<std::string_view> fields;  ///< What its words are: "t", "x" ...
};

/// "`t x y z`", for messages.
std::string toString(const LineFormat& format);

/// The words of the next line that is neither blank nor a comment that `#` begins; they hold until the reader goes on.
/// False after the last.
bool nextWords(LineReader& reader, std::vector<Word>& words);

/// The words of the line that was read last, as numbers.
class LineFields {
 public:
  /// Throws InputError when there are not as many words as the format has fields. All three outlive this.
  LineFields(const LineReader& reader, const std::vector<Word>& words, const LineFormat& format);

  /// Throw InputError when the word is not a time in seconds, or not a finite number.
  common::Time stamp(std::size_t field) const;
  double number(std::size_t field) const;
  /// Throws InputError also when it is beyond kFarthest_m.
  double coordinate_m(std::size_t field) const;

  /// A problem at that field, to be thrown.
  common::InputError problemAt(std::size_t field, std::string element, std::string message,
                               std::string hint = "") const;

 private:
  const LineReader& reader_;
  const std::vector<Word>& words_;
  const LineFormat& format_;
};

}  // namespace swiftlet::interfaces
