// Output to the terminal. It may contain text of an input, so control characters are escaped (see
// common/printable.hpp), except line ends.
#pragma once

#include <string>
#include <vector>

#include "behaviors/tree/problem.hpp"
#include "common/error.hpp"

namespace swiftlet::apps {

/// After this call a reader that goes away does not end the program: `swiftlet fly ... | head -1` is flown to its end.
void outliveReaders();

/// Prints at once, and unlike fmt::print continues if the reader is gone. One thread at a time.
void show(const std::string& text);
/// Prints text that controls the terminal on purpose (colours, a line that is overwritten). Text of an input must be
/// made printable first.
void showStyled(const std::string& text);
/// Prints the text of a JSON value: remaining control characters become \u escapes.
void showJson(const std::string& text);
/// Prints to standard error. It may be lost: the exit code says the same.
void showError(const std::string& text);
/// Shows each as "note: ..." where warnings go.
void showNotes(const std::vector<common::Problem>& notes);

/// "m.xml:4:7: warning: Land: is never reached ... [M/Sequence/Land]"; one line, whatever the names in it hold.
std::string lineOf(tree::Problem problem, bool warning);

}  // namespace swiftlet::apps
