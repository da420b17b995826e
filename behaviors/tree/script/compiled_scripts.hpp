// The scripts of a file, compiled once: the checker compiles each of them, the builder takes it.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {

class CompiledScripts {
 public:
  explicit CompiledScripts(const Constants& constants) : constants_(constants) {}

  /// `text` is the value of an attribute, which lives longer than this object.
  void keep(const std::string& text, std::unique_ptr<Script> script) {
    scripts_.insert_or_assign(&text, std::move(script));
  }

  /// Compiles it if it was not kept, or was taken before, for another use of the same subtree.
  ScriptResult take(const std::string& text) {
    auto kept = scripts_.extract(&text);
    if (kept.empty()) return Script::compile(text, constants_);
    return {std::move(kept.mapped()), {}};
  }

 private:
  const Constants& constants_;
  std::unordered_map<const std::string*, std::unique_ptr<Script>> scripts_;
};

}  // namespace swiftlet::tree
