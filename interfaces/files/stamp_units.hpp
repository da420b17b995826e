// Stamps in another unit than seconds, which files of other programs have: they are not converted, but the messages say
// what they look like.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::interfaces {

/// For a word that is no time in seconds: "it looks like nanoseconds since 1970: divide the stamps by 1e9". Empty for a
/// word that is not a large number.
std::string stampUnitHint(std::string_view word);

/// For stamps of a sensor whose steps have this median: "the stamps are 100 s apart in the median: are they
/// milliseconds? Divide them by 1e3". Empty for the steps of sensors in seconds.
std::string stampStepNote(double median_step_s);

/// The same of a format whose stamps are microseconds, where steps may be too small, too: seconds or milliseconds.
std::string microsecondStepNote(double median_step_s);

}  // namespace swiftlet::interfaces
