// What a reader may do with any text: read it, or refuse it and say why.
#pragma once

#include <cstdlib>

#include "common/error.hpp"

namespace swiftlet::fuzz {

template <typename Read>
void refusedOr(Read&& read) {
  try {
    read();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
}

}  // namespace swiftlet::fuzz
