// The numbers in the texts of SDF elements. libsdformat reads as much of such a text as it can and takes `1,5` for 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "simulation/sdf_text.hpp"

namespace swiftlet::simulation {

/// A problem for each element with a number that the simulator uses, such as <pose> and <size>, whose text is not as
/// many numbers as it takes, with blanks between them. libsdformat decides on elements without a text.
std::vector<common::Problem> numberProblems(const std::string& file, std::string_view text,
                                            const std::vector<SdfTag>& tags);

/// The names of the elements with such numbers that an element can hold: `size` for `box`.
std::vector<std::string> numberElementsOf(std::string_view parent);

}  // namespace swiftlet::simulation
