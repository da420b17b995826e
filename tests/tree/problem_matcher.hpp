// Problems and warnings as tests ask for them: by place and name, not by their English (docs/messages.md has that).
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// "f.xml:3:17 Fly.goal": file, line, column, element; without what is not known.
inline std::string placeOf(const Problem& problem) {
  return toString(problem.location) + (problem.element.empty() ? "" : " " + problem.element);
}

/// For googletest.
inline void PrintTo(const Problem& problem, std::ostream* out) {
  *out << "\n  At(\"" << placeOf(problem) << "\", \"" << problem.message.name() << "\"): " << toString(problem);
}

namespace testing {

MATCHER_P3(IsProblem, place, name, held, "") {
  const std::string line = toString(arg) + " [" + arg.path + "]", here = placeOf(arg);
  return (here == place || here == arg.location.file + ":" + place) && arg.message.name() == name &&
         std::all_of(held.begin(), held.end(), [&](const auto& text) { return line.find(text) != line.npos; });
}

/// A problem of this name at "3:17 Fly.goal", also with the file in front: "f.xml:3:17 Fly.goal". Its line, with the
/// path of its node in brackets, holds each of these names, values and suggestions.
template <typename... Held>
auto At(std::string place, std::string name, Held... held) {
  return IsProblem(std::move(place), std::move(name), std::vector<std::string>{held...});
}

}  // namespace testing
}  // namespace swiftlet::tree
