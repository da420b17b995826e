// What a long run says as it goes.
#pragma once

#include <string>

namespace swiftlet::apps {

/// From now on a reader that goes away does not end the program: `swiftlet fly ... | head -1` is flown to its end.
void outliveReaders();

/// Prints at once, and unlike fmt::print goes on when nobody reads any more. One thread at a time.
void show(const std::string& text);

}  // namespace swiftlet::apps
