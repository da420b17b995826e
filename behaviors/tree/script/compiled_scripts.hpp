// The programs of a file's scripts, each text compiled once: for the checker, and for all nodes that the builder makes.
#pragma once

#include <string_view>
#include <unordered_map>

#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

class CompiledScripts {
 public:
  explicit CompiledScripts(const Constants& constants) : constants_(constants) {}

  /// `text` is the value of an attribute, which lives longer than this object.
  const ProgramResult& compile(std::string_view text) {
    const auto [known, is_new] = programs_.try_emplace(text);
    if (is_new) known->second = ScriptProgram::compile(text, constants_);
    return known->second;
  }

 private:
  const Constants& constants_;
  std::unordered_map<std::string_view, ProgramResult> programs_;
};

}  // namespace swiftlet::tree
