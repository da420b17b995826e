// Switch2 to Switch6: the child of the first case that equals the variable, else the last child. Numbers are compared
// as numbers (1 and 1.0 are equal, `true` is 1), everything else as text; a name of Constants is its number. A variable
// that is not set chooses the last child, and a case that is not set is passed over. The variable is read at every
// tick: when another case becomes true, the child that runs is halted first. The answer is that of the child.
#pragma once

#include <optional>
#include <vector>

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class SwitchNode final : public Composite {
 public:
  SwitchNode(const NodeSetup& setup, std::size_t cases);
  static NodeManifest manifest(std::size_t cases);
  /// The only child that it can choose, because the file fixes the variable and the cases; nullopt if it may choose
  /// more.
  std::optional<std::size_t> alwaysChosen() const;

 private:
  Status run(TickContext& context) override;
  bool onAsked(const TickContext& context) const override;
  /// The child that the variable chooses now.
  std::size_t chosen() const;

  Input<std::string> variable_;
  std::vector<Input<std::string>> cases_;
  const Constants* constants_;
};

}  // namespace swiftlet::tree
