// Misspelt and misplaced elements that say what stands in a world and where. libsdformat leaves out what it does not
// know, with a warning, and the vehicle would fly through it.
#pragma once

#include <string>
#include <string_view>

namespace swiftlet::simulation {

/// Of an element or attribute that SDF does not have in the element around it: what was meant, if that holds, shapes or
/// places things, as "did you mean `collision`?" for `colision` in `link`. Empty if it does not.
std::string spellingHint(std::string_view name, std::string_view parent);

}  // namespace swiftlet::simulation
