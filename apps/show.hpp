// What is said to the terminal. Text of an input may be in all of it, so control characters are escaped (see
// common/printable.hpp) but for the ends of lines.
#pragma once

#include <string>

namespace swiftlet::apps {

/// From now on a reader that goes away does not end the program: `swiftlet fly ... | head -1` is flown to its end.
void outliveReaders();

/// Prints at once, and unlike fmt::print goes on when nobody reads any more. One thread at a time.
void show(const std::string& text);
/// The same for text that commands the terminal on purpose (colours, a line written over). What it has of an input must
/// be printable already.
void showStyled(const std::string& text);
/// The same for the text of a JSON value: what is left of control characters becomes \u escapes.
void showJson(const std::string& text);
/// To standard error, where it need not be seen: the exit code says the same.
void showError(const std::string& text);

}  // namespace swiftlet::apps
