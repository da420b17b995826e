// How large the classes of a header are: data members, with those of structs nested for them, and public methods.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::repository {

struct ClassSize {
  std::string name;
  bool is_struct = false;
  int members = 0;         ///< One of a nested struct's type, or an optional one, counts as that struct's members.
  int public_methods = 0;  ///< Without constructors, destructor and operators.
};

/// The classes and structs at the outermost level of the namespaces of a header that is laid out by clang-format.
std::vector<ClassSize> classSizes(const std::string& header);

}  // namespace swiftlet::repository
